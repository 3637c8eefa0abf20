#include "services/console/transfers.h"

#include <algorithm>
#include <system_error>
#include <utility>
#include <vector>

#include "services/archive/route_file.h"
#include "services/archive/route_file_writer.h"
#include "services/console/src/guarded_in_log.h"
#include "services/console/src/in_words.h"
#include "services/exchange/route_exchange.h"
#include "services/fleet/draw.h"
#include "services/fleet/routes/route_export.h"
#include "services/fleet/routes/route_import.h"

namespace trailcast::console {

namespace fs = std::filesystem;

Transfers::Transfers(Join join, std::chrono::milliseconds timeout)
    : join_(std::move(join)), timeout_(timeout) {}

Transfers::~Transfers() {
  over_ = true;
  for (auto& [id, job] : jobs_) {
    if (job->thread.joinable()) job->thread.join();
  }
}

// Removes transfers that have ended, the oldest first.
Result<Transfers::Job*> Transfers::MakeRoom() {
  if (!folder_) return tl::unexpected(folder_.error());
  const auto under_way = std::count_if(jobs_.begin(), jobs_.end(), [](const auto& job) {
    return job.second->progress.state == State::kUnderWay;
  });
  if (static_cast<std::size_t>(under_way) >= kMostAtOnce) {
    return Fail(ErrorCode::kUnavailable,
                "{} routes are on their way already: try again when one is over", under_way);
  }
  while (jobs_.size() >= kMostKept) {
    const auto oldest = std::find_if(order_.begin(), order_.end(), [&](const std::string& id) {
      return jobs_.at(id)->progress.state != State::kUnderWay;
    });
    const auto gone = jobs_.extract(*oldest);
    order_.erase(oldest);
    if (gone.mapped()->thread.joinable()) gone.mapped()->thread.join();
    std::error_code ignored;
    fs::remove(gone.mapped()->path, ignored);
  }
  auto job = std::make_unique<Job>();
  job->progress.id = fleet::DrawMissionId();
  job->path = *folder_ / (job->progress.id + ".trailcast");
  order_.push_back(job->progress.id);
  return (jobs_[job->progress.id] = std::move(job)).get();
}

// Callers hold the lock.
void Transfers::Start(Job& job, Work work) try {
  job.thread = std::thread([this, &job, work = std::move(work)] {
    fleet::TransferWatch watch;
    watch.timeout = timeout_;
    watch.stop = [this] { return over_.load(); };
    watch.progress = [this, &job](std::uint64_t done_bytes) {
      const std::scoped_lock lock(mutex_);
      job.progress.done_bytes = done_bytes;
    };
    End(job, GuardedInLog("the transfer", [&] { return work(job, watch); }));
  });
} catch (const std::system_error& refused) {
  job.progress.state = State::kFailed;
  job.progress.detail = std::string("no thread could be started for it: ") + refused.what();
}

void Transfers::End(Job& job, const Result<std::string>& result) {
  if (!result || job.progress.is_upload) {
    std::error_code ignored;
    fs::remove(job.path, ignored);
  }
  const std::scoped_lock lock(mutex_);
  job.progress.state = result ? State::kDone : State::kFailed;
  job.progress.detail = result ? *result : result.error().message;
  if (result) job.progress.done_bytes = job.progress.total_bytes;
}

Result<Transfers::Progress> Transfers::Fetch(const route::RouteInfo& info) {
  const std::scoped_lock lock(mutex_);
  const auto made = MakeRoom();
  if (!made) return tl::unexpected(made.error());
  Job& job = **made;
  job.progress.route = info.name;
  job.progress.revision = info.revision.value();
  job.progress.total_bytes = info.bytes;
  Start(job, [this, info](Job& own, const fleet::TransferWatch& watch) {
    return FetchTo(own, info, watch);
  });
  return job.progress;
}

Result<std::string> Transfers::FetchTo(Job& job, const route::RouteInfo& info,
                                       const fleet::TransferWatch& watch) {
  auto writer = archive::RouteFileWriter::Create(job.path, info,
                                                 archive::RouteFileWriter::Existing::kReplace);
  if (!writer) return tl::unexpected(writer.error());
  auto peer = join_(fleet::ExporterTopics());
  if (!peer) return tl::unexpected(peer.error());
  const auto bytes = fleet::ExportFromServer(*peer, info, std::move(*writer), watch);
  if (!bytes) return tl::unexpected(bytes.error());
  return fmt::format("{} bytes, checked", *bytes);
}

Result<Transfers::Upload> Transfers::BeginUpload(std::uint64_t bytes) {
  const std::scoped_lock lock(mutex_);
  const auto made = MakeRoom();
  if (!made) return tl::unexpected(made.error());
  Job& job = **made;
  job.progress.is_upload = true;
  job.progress.total_bytes = bytes;
  return Upload{job.progress.id, job.path};
}

Transfers::Progress Transfers::Deliver(const std::string& id) {
  const std::scoped_lock lock(mutex_);
  Job& job = *jobs_.at(id);
  Start(job,
        [this](Job& own, const fleet::TransferWatch& watch) { return DeliverFrom(own, watch); });
  return job.progress;
}

Result<std::string> Transfers::DeliverFrom(Job& job, const fleet::TransferWatch& watch) {
  const auto file = archive::RouteFile::Open(job.path);
  if (!file) {
    return Fail(file.error().code, "this is no whole route file, as Download writes them: {}",
                InWords(file.error(), job.path, "the file").message);
  }
  const route::RouteInfo& info = file->info();
  {
    const std::scoped_lock lock(mutex_);
    job.progress.route = info.name;
    job.progress.revision = info.revision.value();
    job.progress.total_bytes = info.bytes;
  }
  auto peer = join_(fleet::ImporterTopics());
  if (!peer) return tl::unexpected(peer.error());
  const auto imported = fleet::ImportToServer(*file, *peer, watch);
  if (!imported) return tl::unexpected(imported.error());
  return fmt::format(
      "{} {}", imported->was_there ? "was there already:" : "is there now:", imported->holder);
}

void Transfers::GiveUp(const std::string& id) {
  Job* job = nullptr;
  {
    const std::scoped_lock lock(mutex_);
    job = jobs_.at(id).get();
  }
  End(*job, Fail(ErrorCode::kUnavailable, "the upload was cut off"));
}

Result<Transfers::Progress> Transfers::Find(const std::string& id) {
  const std::scoped_lock lock(mutex_);
  const auto job = jobs_.find(id);
  if (job != jobs_.end()) return job->second->progress;
  return Fail(ErrorCode::kNotFound, "there is no such transfer, or no more");
}

Result<Transfers::File> Transfers::FileOf(const std::string& id) {
  const std::scoped_lock lock(mutex_);
  const auto job = jobs_.find(id);
  if (job == jobs_.end()) {
    return Fail(ErrorCode::kNotFound, "there is no such transfer, or no more");
  }
  const Progress& progress = job->second->progress;
  if (progress.is_upload || progress.state != State::kDone) {
    return Fail(ErrorCode::kNotFound, "there is no file of this transfer: {}",
                progress.detail.empty() ? "it is under way" : progress.detail);
  }
  return File{job->second->path,
              fmt::format("{}-r{}.trailcast", progress.route, progress.revision)};
}

}  // namespace trailcast::console
