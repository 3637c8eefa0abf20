#pragma once

#include <condition_variable>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "services/base/result.h"
#include "services/console/alerts.h"

namespace trailcast::console {

// This is a file in which alerts outlive the console. It writes the latest alerts in a thread of
// its own, so that the thread that hears robots waits for no disk.
class AlertFile {
 public:
  static constexpr std::size_t kMostBytes = 8U << 20U;

  // Opens a file, which has no alerts if it does not exist. Fails with kCorrupt, which names the
  // file, if it has something else, and with kUnavailable if it cannot be written.
  [[nodiscard]] static Result<std::unique_ptr<AlertFile>> Open(const std::filesystem::path& file);
  // Returns when the alerts that were last handed over are on the disk, if the disk takes them.
  ~AlertFile();
  AlertFile(const AlertFile&) = delete;
  AlertFile& operator=(const AlertFile&) = delete;

  [[nodiscard]] const Alerts& alerts() const { return alerts_; }  // as they were in the file
  // Hands over the file's new content, and waits for nothing.
  void Keep(std::string text);

 private:
  AlertFile(std::filesystem::path file, Alerts alerts);
  void Run();

  const std::filesystem::path file_;
  const Alerts alerts_;
  std::mutex mutex_;  // guards what follows
  bool over_ = false;
  std::optional<std::string> next_;
  std::condition_variable changed_;
  std::thread thread_;
};

}  // namespace trailcast::console
