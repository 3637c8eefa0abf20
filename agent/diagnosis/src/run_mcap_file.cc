#include "agent/diagnosis/src/run_mcap_file.h"

#include <fmt/format.h>

#include <thread>

namespace trailcast::agent {
namespace {

// Four seconds of frames, which have a picture each.
constexpr std::size_t kMostWaiting = 128;
constexpr std::chrono::milliseconds kRoomComes{1};

std::string AsText(const bag::Bytes& bytes) { return {bytes.begin(), bytes.end()}; }

}  // namespace

Result<std::unique_ptr<RunMcapFile>> RunMcapFile::Create(const std::filesystem::path& file,
                                                         double picture_every_s) {
  auto opened = RunLogFile::Create(file, kMostWaiting);
  if (!opened) return tl::unexpected(opened.error());
  return std::unique_ptr<RunMcapFile>(new RunMcapFile(std::move(*opened), picture_every_s));
}

void RunMcapFile::Put(RunMoment moment, bool patient) {
  if (dropped_ > 0) {
    moment.text =
        fmt::format("# dropped {} frames: writing did not keep up\n", dropped_) + moment.text;
  }
  RunLogFile::Make make = [this, moment = std::move(moment)] {
    mcap_.Add(moment);
    return AsText(mcap_.TakeBytes());
  };
  bool put = file_->TryPut(std::move(make));
  file_->Hurry();
  while (!put && patient) {
    std::this_thread::sleep_for(kRoomComes);
    put = file_->TryPut(std::move(make));
  }
  dropped_ = put ? 0 : dropped_ + 1;
}

Result<void> RunMcapFile::Close(const RunMoment& last) {
  return file_->Close([&] {
    mcap_.Add(last);
    mcap_.End();
    return AsText(mcap_.TakeBytes());
  });
}

}  // namespace trailcast::agent
