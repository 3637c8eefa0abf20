#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "agent/diagnosis/run_log.h"
#include "agent/diagnosis/run_pictures.h"
#include "services/base/result.h"
#include "services/base/work_folder.h"
#include "services/console/run_folder.h"
#include "services/console/runs_query.h"
#include "services/explain/story.h"

namespace trailcast::console {

// This is a run as a list shows it. Values that its log does not have are empty.
struct RunSummary {
  std::string robot{};
  std::string route{};
  std::string revision{};
  std::string mission{};
  std::string method{};
  std::optional<double> began_unix_ms{};
  double lasted_s = 0.0;
  std::optional<double> driven_m{};
  double progress = 0.0;  // share of the route
  std::string state{};    // its last state; empty if its log breaks off
  std::string reason{};
};
[[nodiscard]] RunSummary Summarise(const agent::RunLog& log);

// This is a log that was read. Its pictures are searched in its file, by one thread at a time.
class OpenedRun {
 public:
  OpenedRun(RunFile file, agent::RunLog log, std::unique_ptr<agent::RunPictures> pictures);

  RunFile file;
  agent::RunLog log;
  RunSummary summary;
  explain::Story story;
  [[nodiscard]] bool has_pictures() const { return pictures_ != nullptr; }

  // This is what a frame shows. The row must exist. Fails with kUnavailable if other threads search
  // for too many pictures already.
  struct Seen {
    std::vector<agent::SeenFeature> features;
    std::optional<agent::RunPictures::Picture> picture;
  };
  [[nodiscard]] Result<Seen> SeenIn(std::size_t row) const;

 private:
  mutable std::timed_mutex mutex_;
  std::unique_ptr<agent::RunPictures> pictures_;
};

// These are the logs of runs in a folder, and those that people uploaded. One thread of low
// priority reads all of them. It may be used from any thread.
class Runs {
 public:
  static constexpr std::size_t kMostUploads = 4;  // uploads that are kept
  static constexpr std::size_t kMostUploadsAtOnce = 2;
  static constexpr std::uint64_t kMostUploadBytes = 128U << 20U;
  static constexpr std::size_t kMostWanted = 8;          // logs that wait to be read
  static constexpr std::size_t kMostWaiting = 4;         // threads that wait for them
  static constexpr std::size_t kMostRows = 200'000;      // of one log
  static constexpr std::size_t kMostRowsKept = 400'000;  // of all logs that are kept
  static constexpr std::size_t kMostEvents = 20'000;
  static constexpr std::size_t kMostAPage = 50;

  // An empty `folder` means that there is none.
  explicit Runs(std::filesystem::path folder);
  ~Runs();
  Runs(const Runs&) = delete;
  Runs& operator=(const Runs&) = delete;

  struct Listed {
    RunFile file;
    RunSummary summary;
    bool is_written = false;  // it is still being written
  };
  struct Page {
    std::vector<Listed> runs;  // the last written first
    std::size_t next = 0;      // to be skipped for the next page; 0 if there is none
    std::size_t unread = 0;    // files that were not read yet
  };
  // Returns a page, after waiting for all logs to be summarised for at most `most`. Fails with
  // kConflict if there is no folder.
  [[nodiscard]] Result<Page> List(const RunsQuery& query, std::chrono::milliseconds most);

  // Returns a run, after waiting for it for at most `most`, or null if it is not read yet. Fails
  // with kNotFound; with kUnavailable if too many wait to be read; and with another error that says
  // why it cannot be read.
  [[nodiscard]] Result<std::shared_ptr<const OpenedRun>> Find(const std::string& id,
                                                              std::chrono::milliseconds most);

  // This is a log that is being uploaded. It is to be written to `path`, and is then found under
  // its id, or dropped.
  struct Upload {
    std::string id;
    std::filesystem::path path;
  };
  // Fails with kUnavailable if others are being uploaded.
  [[nodiscard]] Result<Upload> BeginUpload();
  void EndUpload(const Upload& upload, bool whole);

  // Ends reading, and releases all callers that wait.
  void Close();

 private:
  using Clock = std::chrono::steady_clock;
  struct Entry {
    RunFile file;
    std::optional<RunFile> looked_at;     // as it was when it was summarised
    std::optional<RunSummary> summary{};  // empty if it is no log
    Clock::time_point at{};
  };
  struct Opened {
    RunFile file;
    Result<std::shared_ptr<const OpenedRun>> run;
    Clock::time_point at{};
  };
  struct Kept {
    RunFile file;
    std::filesystem::path path{};  // for an upload; empty if it is in the folder
  };

  void Run();
  // Callers hold mutex_, which these release while they work on a file.
  bool Work(std::unique_lock<std::mutex>& lock);
  void Scan(std::unique_lock<std::mutex>& lock);
  void LookAt(std::unique_lock<std::mutex>& lock, const std::string& id);
  void Read(std::unique_lock<std::mutex>& lock, const std::string& id);
  [[nodiscard]] std::string NextToLookAt() const;
  [[nodiscard]] std::optional<Kept> FileOf(const std::string& id) const;
  [[nodiscard]] const Opened* Held(const RunFile& file);
  [[nodiscard]] Result<OpenFile> OpenLog(const Kept& kept) const;
  [[nodiscard]] Result<std::shared_ptr<const OpenedRun>> Open(const Kept& kept) const;
  void Keep(Opened opened);

  const std::optional<RunFolder> folder_;
  const Result<WorkFolder> uploads_folder_ = WorkFolder::Make();

  mutable std::mutex mutex_;  // guards what follows
  bool closed_ = false;
  std::size_t waiting_ = 0;
  std::optional<Error> scan_failed_;
  std::optional<Clock::time_point> scanned_at_;
  bool asked_ = false;                    // for a list
  std::map<std::string, Entry> entries_;  // by id
  std::vector<std::string> order_;        // the last written first
  std::deque<Kept> uploads_;              // the oldest first
  std::size_t uploading_ = 0;
  std::deque<std::string> wanted_;
  std::deque<Opened> opened_;  // the last used last
  std::condition_variable changed_;

  std::thread thread_;
};

}  // namespace trailcast::console
