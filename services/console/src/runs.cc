#include "services/console/runs.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <numeric>
#include <utility>

#include "agent/diagnosis/run_log_reader.h"
#include "services/base/give_way.h"
#include "services/base/unix_time.h"
#include "services/console/src/guarded_in_log.h"
#include "services/console/src/in_words.h"
#include "services/fleet/draw.h"

namespace trailcast::console {
namespace {

namespace fs = std::filesystem;
using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr seconds kScanAgain{2};
// The log of a run that is under way changes every second.
constexpr seconds kReadAgain{10};
constexpr std::int64_t kStillWritten_ms = 15'000;
constexpr std::size_t kMostOpened = 8;
constexpr std::size_t kMostHappenings = 100;
constexpr std::size_t kMostLogBytes = 128U << 20U;
constexpr milliseconds kOthersLook{2000};
constexpr const char* kReader = "the thread that reads logs";
constexpr const char* kUploaded = "the uploaded log";

bool Fits(const std::string& wanted, const std::string& is) {
  return wanted.empty() || wanted == is;
}

}  // namespace

RunSummary Summarise(const agent::RunLog& log) {
  const auto text = [&](const char* key) { return log.header.Find(key).value_or(""); };
  RunSummary summary{.robot = text("robot"),
                     .route = text("route"),
                     .revision = text("revision"),
                     .mission = text("mission"),
                     .method = text("method"),
                     .began_unix_ms = log.header.Number("began_unix_ms")};
  if (!log.frames.empty()) {
    const agent::FrameRow& last = log.frames.back();
    summary.lasted_s = last.t_s - log.frames.front().t_s;
    summary.driven_m = last.driven_m;
    summary.progress = last.progress;
  }
  if (log.ending) {
    summary.state = log.ending->fields.Find("state").value_or("ended");
    summary.reason = log.ending->text;
  }
  return summary;
}

OpenedRun::OpenedRun(RunFile from, agent::RunLog read, std::unique_ptr<agent::RunPictures> pictures)
    : file(std::move(from)),
      log(std::move(read)),
      summary(Summarise(log)),
      story(explain::MakeStory(log, kMostHappenings)),
      pictures_(std::move(pictures)) {}

Result<OpenedRun::Seen> OpenedRun::SeenIn(std::size_t row) const {
  if (!pictures_) return Seen{};
  const std::unique_lock lock(mutex_, kOthersLook);
  if (!lock) return Fail(ErrorCode::kUnavailable, "others look at this run already: try again");
  const double t_s = log.frames[row].t_s;
  auto features = pictures_->FeaturesAt(t_s);
  if (!features) return tl::unexpected(features.error());
  auto picture = pictures_->PictureUntil(t_s);
  if (!picture) return tl::unexpected(picture.error());
  return Seen{*std::move(features), *std::move(picture)};
}

Runs::Runs(fs::path folder)
    : folder_(folder.empty() ? std::nullopt : std::optional<RunFolder>(std::move(folder))),
      thread_([this] { Run(); }) {}

Runs::~Runs() {
  Close();
  thread_.join();
}

void Runs::Close() {
  const std::scoped_lock lock(mutex_);
  closed_ = true;
  changed_.notify_all();
}

void Runs::Run() {
  // A person waits for this thread, so it keeps a tenth of what a busy thread of another program
  // gets.
  constexpr int kATenth = 10;
  GiveWay(kATenth);
  std::unique_lock lock(mutex_);
  while (!closed_) {
    if (Work(lock)) {
      changed_.notify_all();
    } else {
      changed_.wait(lock);
    }
  }
}

bool Runs::Work(std::unique_lock<std::mutex>& lock) {
  if (!wanted_.empty()) {
    Read(lock, wanted_.front());
    return true;
  }
  if (asked_) {
    Scan(lock);
    return true;
  }
  const std::string next = NextToLookAt();
  if (next.empty()) return false;
  LookAt(lock, next);
  return true;
}

void Runs::Scan(std::unique_lock<std::mutex>& lock) {
  asked_ = false;
  if (!folder_ || (scanned_at_ && Clock::now() < *scanned_at_ + kScanAgain)) return;
  lock.unlock();
  auto files = GuardedInLog(kReader, [this] { return folder_->Scan(); });
  lock.lock();
  scanned_at_ = Clock::now();
  scan_failed_ = files ? std::nullopt : std::optional(files.error());
  if (!files) return;
  std::map<std::string, Entry> entries;
  order_.clear();
  for (RunFile& file : *files) {
    order_.push_back(file.id);
    auto known = entries_.extract(file.id);
    Entry& entry = entries[file.id] = known ? std::move(known.mapped()) : Entry{};
    entry.file = std::move(file);
  }
  entries_ = std::move(entries);
}

// A file that changes all the time is read again when it has come to rest.
std::string Runs::NextToLookAt() const {
  for (const std::string& id : order_) {
    const Entry& entry = entries_.at(id);
    const bool rests = NowUnixMs() - entry.file.written_unix_ms > kStillWritten_ms;
    if (!entry.looked_at || (rests && *entry.looked_at != entry.file)) return id;
  }
  return "";
}

void Runs::LookAt(std::unique_lock<std::mutex>& lock, const std::string& id) {
  const RunFile file = entries_.at(id).file;
  lock.unlock();
  auto looked = GuardedInLog(kReader, [&]() -> Result<std::optional<RunSummary>> {
    const auto opened = OpenLog({file});
    if (!opened) return std::nullopt;
    const auto log = agent::ReadRunEnds(opened->path());
    return log ? std::optional(Summarise(*log)) : std::nullopt;
  });
  lock.lock();
  const auto entry = entries_.find(id);
  if (entry == entries_.end()) return;
  entry->second.looked_at = file;
  entry->second.summary =
      looked ? *std::move(looked) : RunSummary{.reason = looked.error().message};
}

// An upload may have been dropped for others meanwhile.
Result<OpenFile> Runs::OpenLog(const Kept& kept) const {
  if (kept.path.empty()) return folder_->Open(kept.file);
  const int descriptor = ::open(kept.path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return Fail(ErrorCode::kNotFound, "this log is there no more");
  return OpenFile(descriptor);
}

void Runs::Read(std::unique_lock<std::mutex>& lock, const std::string& id) {
  const auto kept = FileOf(id);
  if (!kept) {
    wanted_.pop_front();
    return;
  }
  lock.unlock();
  const auto began = Clock::now();
  auto run = GuardedInLog(kReader, [&] { return Open(*kept); });
  lock.lock();
  wanted_.pop_front();
  Keep({kept->file, std::move(run), began});
}

Result<std::shared_ptr<const OpenedRun>> Runs::Open(const Kept& kept) const {
  const auto opened = OpenLog(kept);
  if (!opened) return Fail(ErrorCode::kNotFound, "this log is there no more");
  auto log = agent::ReadRunLog(
      opened->path(), {.messages = kMostRows, .events = kMostEvents, .bytes = kMostLogBytes});
  if (!log) return tl::unexpected(InWords(log.error(), opened->path(), kept.file.name));
  // A log without pictures is still a log.
  auto pictures = agent::RunPictures::Open(opened->path());
  return std::make_shared<const OpenedRun>(kept.file, *std::move(log),
                                           pictures ? *std::move(pictures) : nullptr);
}

void Runs::Keep(Opened opened) {
  std::erase_if(opened_, [&](const Opened& each) { return each.file.id == opened.file.id; });
  opened_.push_back(std::move(opened));
  const auto rows = [](std::size_t sum, const Opened& each) {
    return sum + (each.run ? (*each.run)->log.frames.size() : 0);
  };
  while (opened_.size() > 1 &&
         (opened_.size() > kMostOpened ||
          std::accumulate(opened_.begin(), opened_.end(), std::size_t{0}, rows) > kMostRowsKept)) {
    opened_.pop_front();
  }
}

std::optional<Runs::Kept> Runs::FileOf(const std::string& id) const {
  for (const Kept& each : uploads_) {
    if (each.file.id == id) return each;
  }
  const auto entry = entries_.find(id);
  return entry == entries_.end() ? std::nullopt : std::optional(Kept{entry->second.file});
}

// Returns null if it is not read, or has grown meanwhile.
const Runs::Opened* Runs::Held(const RunFile& file) {
  const auto found = std::find_if(opened_.begin(), opened_.end(),
                                  [&](const Opened& each) { return each.file.id == file.id; });
  if (found == opened_.end()) return nullptr;
  if (found->file != file && Clock::now() > found->at + kReadAgain) return nullptr;
  std::rotate(found, found + 1, opened_.end());
  return &opened_.back();
}

Result<std::shared_ptr<const OpenedRun>> Runs::Find(const std::string& id, milliseconds most) {
  const auto until = Clock::now() + most;
  std::unique_lock lock(mutex_);
  asked_ = folder_.has_value();
  changed_.notify_all();
  const bool may_wait = waiting_ < kMostWaiting;
  ++waiting_;
  const std::shared_ptr<void> leave(nullptr, [this](void*) { --waiting_; });
  while (!closed_) {
    const auto kept = FileOf(id);
    if (!kept && (!folder_ || scanned_at_)) {
      return Fail(ErrorCode::kNotFound, "there is no such run, or its log is there no more");
    }
    if (kept) {
      if (const Opened* held = Held(kept->file)) return held->run;
      if (std::find(wanted_.begin(), wanted_.end(), id) == wanted_.end()) {
        if (wanted_.size() >= kMostWanted) {
          return Fail(ErrorCode::kUnavailable, "too many logs wait to be read: try again");
        }
        wanted_.push_back(id);
        changed_.notify_all();
      }
    }
    if (!may_wait || changed_.wait_until(lock, until) == std::cv_status::timeout) break;
  }
  return nullptr;
}

Result<Runs::Page> Runs::List(const RunsQuery& query, milliseconds most) {
  if (!folder_) {
    return Fail(ErrorCode::kConflict,
                "this console has no logs of runs: start it with --logs FOLDER, or drop one here");
  }
  std::unique_lock lock(mutex_);
  asked_ = true;
  changed_.notify_all();
  const auto all_is_known = [&] {
    return closed_ || (!asked_ && scanned_at_ && NextToLookAt().empty());
  };
  if (waiting_ < kMostWaiting) {
    ++waiting_;
    (void)changed_.wait_for(lock, most, all_is_known);
    --waiting_;
  }
  if (scan_failed_) return tl::unexpected(*scan_failed_);
  Page page;
  std::size_t fitting = 0;
  const auto now_ms = NowUnixMs();
  for (const std::string& id : order_) {
    const Entry& entry = entries_.at(id);
    if (!entry.looked_at) ++page.unread;
    if (!entry.summary || !Fits(query.robot, entry.summary->robot) ||
        !Fits(query.route, entry.summary->route) || !Fits(query.mission, entry.summary->mission)) {
      continue;
    }
    if (fitting++ < query.skip) continue;
    if (page.runs.size() == kMostAPage) {
      page.next = query.skip + kMostAPage;
      continue;
    }
    const bool is_written =
        entry.summary->state.empty() && now_ms - entry.file.written_unix_ms <= kStillWritten_ms;
    page.runs.push_back({entry.file, *entry.summary, is_written});
  }
  return page;
}

Result<Runs::Upload> Runs::BeginUpload() {
  if (!uploads_folder_) return tl::unexpected(uploads_folder_.error());
  const std::scoped_lock lock(mutex_);
  if (uploading_ >= kMostUploadsAtOnce) {
    return Fail(ErrorCode::kUnavailable, "others upload logs already: try again when that is over");
  }
  ++uploading_;
  const std::string id = fleet::DrawMissionId();
  return Upload{id, *uploads_folder_ / id};
}

void Runs::EndUpload(const Upload& upload, bool whole) {
  std::error_code ignored;
  const auto bytes = fs::file_size(upload.path, ignored);
  const std::scoped_lock lock(mutex_);
  --uploading_;
  fs::path goes = upload.path;
  if (whole) {
    uploads_.push_back({{upload.id, kUploaded, bytes, NowUnixMs()}, upload.path});
    if (uploads_.size() <= kMostUploads) return;
    goes = uploads_.front().path;
    uploads_.pop_front();
  }
  fs::remove(goes, ignored);
}

}  // namespace trailcast::console
