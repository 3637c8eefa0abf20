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

// What a list has of a run. Nothing: its log does not say.
struct RunSummary {
  std::string robot{};
  std::string route{};
  std::string revision{};
  std::string mission{};
  std::string method{};
  std::optional<double> began_unix_ms{};
  double lasted_s = 0.0;
  std::optional<double> driven_m{};
  double progress = 0.0;  // of the route
  std::string state{};    // in which it ended; empty: its log breaks off
  std::string reason{};
};
[[nodiscard]] RunSummary Summarise(const agent::RunLog& log);

// A log that was read; pictures are looked up in its file, by one thread at a time.
class OpenedRun {
 public:
  OpenedRun(RunFile file, agent::RunLog log, std::unique_ptr<agent::RunPictures> pictures);

  RunFile file;
  agent::RunLog log;
  RunSummary summary;
  explain::Story story;
  [[nodiscard]] bool has_pictures() const { return pictures_ != nullptr; }

  // kUnavailable: others look for too many already. Of a row that is there.
  struct Seen {
    std::vector<agent::SeenFeature> features;
    std::optional<agent::RunPictures::Picture> picture;
  };
  [[nodiscard]] Result<Seen> SeenIn(std::size_t row) const;

 private:
  mutable std::timed_mutex mutex_;
  std::unique_ptr<agent::RunPictures> pictures_;
};

// The logs of runs in a folder, and those that people uploaded. All of them are read by one thread
// of low priority. May be used from any thread.
class Runs {
 public:
  static constexpr std::size_t kMostUploads = 4;  // that are kept
  static constexpr std::size_t kMostUploadsAtOnce = 2;
  static constexpr std::uint64_t kMostUploadBytes = 128U << 20U;
  static constexpr std::size_t kMostWanted = 8;          // that wait to be read
  static constexpr std::size_t kMostWaiting = 4;         // threads that wait for it
  static constexpr std::size_t kMostRows = 200'000;      // of a log,
  static constexpr std::size_t kMostRowsKept = 400'000;  // and of all that are kept
  static constexpr std::size_t kMostEvents = 20'000;
  static constexpr std::size_t kMostAPage = 50;

  // `folder`: empty: there is none.
  explicit Runs(std::filesystem::path folder);
  ~Runs();
  Runs(const Runs&) = delete;
  Runs& operator=(const Runs&) = delete;

  struct Listed {
    RunFile file;
    RunSummary summary;
    bool is_written = false;  // to, still
  };
  struct Page {
    std::vector<Listed> runs;  // the last written first
    std::size_t next = 0;      // to be skipped for the next page; 0: there is none
    std::size_t unread = 0;    // files that are not looked at yet
  };
  // Waits for all to be looked at, up to `most`. kConflict: there is no folder.
  [[nodiscard]] Result<Page> List(const RunsQuery& query, std::chrono::milliseconds most);

  // Waits for it, up to `most`; null: it is not read yet. kNotFound; kUnavailable: too many wait to
  // be read; another error: it cannot be read, and why.
  [[nodiscard]] Result<std::shared_ptr<const OpenedRun>> Find(const std::string& id,
                                                              std::chrono::milliseconds most);

  // A log that is uploaded: to be written to `path`, and then found under its id, or dropped.
  struct Upload {
    std::string id;
    std::filesystem::path path;
  };
  // kUnavailable: others are under way.
  [[nodiscard]] Result<Upload> BeginUpload();
  void EndUpload(const Upload& upload, bool whole);

  // Nothing is read any more, and whoever waits is let go.
  void Close();

 private:
  using Clock = std::chrono::steady_clock;
  struct Entry {
    RunFile file;
    std::optional<RunFile> looked_at;     // as it was then
    std::optional<RunSummary> summary{};  // nothing: not a log
    Clock::time_point at{};
  };
  struct Opened {
    RunFile file;
    Result<std::shared_ptr<const OpenedRun>> run;
    Clock::time_point at{};
  };
  struct Kept {
    RunFile file;
    std::filesystem::path path{};  // of an uploaded one; empty: it is in the folder
  };

  void Run();
  // With mutex_ held, which these let go while they work on a file.
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
  bool asked_ = false;                    // what is there
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
