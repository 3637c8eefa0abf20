#include "services/console/alert_file.h"

#include <spdlog/spdlog.h>

#include <utility>

#include "services/base/durable_file.h"
#include "services/console/src/guarded_in_log.h"

namespace trailcast::console {

namespace fs = std::filesystem;

Result<std::unique_ptr<AlertFile>> AlertFile::Open(const fs::path& file) {
  Alerts alerts;
  if (const auto text = ReadBoundedFile(file, kMostBytes)) {
    auto read = Alerts::Read(*text);
    if (!read) return Wrap(read.error(), file.string());
    alerts = *std::move(read);
  } else if (text.error().code != ErrorCode::kNotFound) {
    return tl::unexpected(text.error());
  }
  if (auto written = ReplaceFile(file, alerts.Text()); !written) {
    return tl::unexpected(written.error());
  }
  return std::unique_ptr<AlertFile>(new AlertFile(file, std::move(alerts)));
}

AlertFile::AlertFile(fs::path file, Alerts alerts)
    : file_(std::move(file)), alerts_(std::move(alerts)), thread_([this] { Run(); }) {}

AlertFile::~AlertFile() {
  {
    const std::scoped_lock lock(mutex_);
    over_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void AlertFile::Keep(std::string text) {
  {
    const std::scoped_lock lock(mutex_);
    next_ = std::move(text);
  }
  changed_.notify_all();
}

void AlertFile::Run() {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [&] { return over_ || next_; });
    if (!next_) return;
    const std::string text = *std::exchange(next_, std::nullopt);
    lock.unlock();
    const auto written =
        GuardedInLog("the thread that keeps alerts", [&] { return ReplaceFile(file_, text); });
    if (!written) spdlog::error("console: alerts are not kept: {}", written.error().message);
    lock.lock();
  }
}

}  // namespace trailcast::console
