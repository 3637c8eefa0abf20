#include "agent/diagnosis/src/run_mcap_file.h"

#include <fmt/format.h>

#include <thread>

namespace trailcast::agent {
namespace {

// This is four seconds of frames with a picture each.
constexpr std::size_t kMostWaiting = 128;
constexpr std::chrono::milliseconds kRoomComes{1};

}  // namespace

Result<std::unique_ptr<RunMcapFile>> RunMcapFile::Create(const std::filesystem::path& file,
                                                         double picture_every_s) {
  auto opened = RunLogFile::Create(file, kMostWaiting);
  if (!opened) return tl::unexpected(opened.error());
  return std::unique_ptr<RunMcapFile>(new RunMcapFile(std::move(*opened), picture_every_s));
}

void RunMcapFile::TellDropped(RunMoment& next) const {
  if (dropped_ == 0) return;
  RunEvent dropped{.what = "dropped",
                   .text = fmt::format("{} frames: writing did not keep up", dropped_)};
  if (!next.events.empty()) {
    dropped.frame = next.events.front().frame;
    dropped.t_s = next.events.front().t_s;
  } else if (next.row) {
    dropped.frame = next.row->frame;
    dropped.t_s = next.row->t_s;
  }
  next.events.insert(next.events.begin(), std::move(dropped));
}

void RunMcapFile::Put(RunMoment moment, bool patient) {
  TellDropped(moment);
  RunLogFile::Make make = [this, moment = std::move(moment)] {
    mcap_.Add(moment);
    return mcap_.TakeBytes();
  };
  bool put = file_->TryPut(std::move(make));
  while (!put && patient) {
    std::this_thread::sleep_for(kRoomComes);
    put = file_->TryPut(std::move(make));
  }
  dropped_ = put ? 0 : dropped_ + 1;
}

Result<void> RunMcapFile::Close(RunMoment last) {
  TellDropped(last);
  return file_->Close([&] {
    mcap_.Add(last);
    mcap_.End();
    return mcap_.TakeBytes();
  });
}

}  // namespace trailcast::agent
