#include "agent/diagnosis/run_log_file.h"

#include <utility>

#include "services/base/guarded.h"

namespace trailcast::agent {
namespace {

constexpr std::chrono::milliseconds kWriteEvery{250};

}  // namespace

Result<std::unique_ptr<RunLogFile>> RunLogFile::Create(const std::filesystem::path& file,
                                                       std::size_t capacity) {
  std::FILE* stream = std::fopen(file.c_str(), "wb");
  if (stream == nullptr) {
    return Fail(ErrorCode::kUnavailable,
                "cannot write {}: does its folder exist, and may this user write there?",
                file.string());
  }
  return std::unique_ptr<RunLogFile>(new RunLogFile(stream, file, capacity));
}

RunLogFile::RunLogFile(std::FILE* stream, std::filesystem::path file, std::size_t capacity)
    : file_(std::move(file)), stream_(stream), waiting_(capacity), thread_([this] { Write(); }) {}

RunLogFile::~RunLogFile() { std::ignore = Close(); }

void RunLogFile::WriteBytes(const bag::Bytes& bytes) {
  bytes_ += bytes.size();
  failed_ = failed_ || std::fwrite(bytes.data(), 1, bytes.size(), stream_) != bytes.size();
}

void RunLogFile::WriteWaiting() {
  while (const auto make = waiting_.TryGet()) WriteBytes((*make)());
  failed_ = std::fflush(stream_) != 0 || failed_;
}

void RunLogFile::Write() {
  const auto written = Guarded("the thread that writes the log", [this] { WriteUntilItEnds(); });
  failed_ = failed_ || !written;
}

void RunLogFile::WriteUntilItEnds() {
  while (!ending_.load()) {
    bell_.Wait(kWriteEvery);
    WriteWaiting();
  }
  WriteWaiting();
}

Result<void> RunLogFile::Close(const Make& last) {
  if (thread_.joinable()) {
    ending_.store(true);
    bell_.Ring();
    thread_.join();
    WriteBytes(last());
    failed_ = std::fclose(stream_) != 0 || failed_;
  }
  if (!failed_) return {};
  return Fail(ErrorCode::kUnavailable, "{} is not complete: is the disk full?", file_.string());
}

}  // namespace trailcast::agent
