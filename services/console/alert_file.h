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

// A file in which alerts outlive the console. A thread of its own writes the latest of them: who
// hears robots waits for no disk.
class AlertFile {
 public:
  static constexpr std::size_t kMostBytes = 8U << 20U;

  // Nothing is in it yet where there is no file; kCorrupt, naming it, where there is something
  // else; kUnavailable where it cannot be written.
  [[nodiscard]] static Result<std::unique_ptr<AlertFile>> Open(const std::filesystem::path& file);
  // What was last handed over is on the disk when it returns, if the disk takes it.
  ~AlertFile();
  AlertFile(const AlertFile&) = delete;
  AlertFile& operator=(const AlertFile&) = delete;

  [[nodiscard]] const Alerts& alerts() const { return alerts_; }  // as they were in it
  // Hands over what is to be in it, and waits for nothing.
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
