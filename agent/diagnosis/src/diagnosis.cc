#include "agent/diagnosis/diagnosis.h"

#include <fmt/format.h>

#include "agent/diagnosis/src/frame_view.h"
#include "agent/diagnosis/src/run_mcap_file.h"
#include "services/image/files.h"

namespace trailcast::agent {

Diagnosis::Diagnosis(DiagnosisOptions options) : options_(std::move(options)) {}
Diagnosis::~Diagnosis() = default;
Diagnosis::Diagnosis(Diagnosis&&) noexcept = default;
Diagnosis& Diagnosis::operator=(Diagnosis&&) noexcept = default;

Result<Diagnosis> Diagnosis::Open(const DiagnosisOptions& options) {
  Diagnosis diagnosis(options);
  if (!options.log.empty()) {
    auto file = RunMcapFile::Create(options.log, options.picture_every_s);
    if (!file) return tl::unexpected(file.error());
    diagnosis.log_ = std::move(*file);
  }
  std::error_code failed;
  if (!options.view.empty()) std::filesystem::create_directories(options.view, failed);
  if (failed) {
    return Fail(ErrorCode::kUnavailable, "cannot make the folder {}: {}", options.view.string(),
                failed.message());
  }
  return diagnosis;
}

void Diagnosis::Begin(const RunFacts& facts) {
  Fields header = RunRecorder::Begin(facts);
  for (const auto& [key, value] : options_.header.all()) header.Add(key, value);
  if (log_) log_->Put({.header = std::move(header)}, options_.patient);
  begun_ = true;
}

void Diagnosis::Add(const RunFrame& seen, const ReplaySession& session, const ReplayStep& step) {
  if (log_) Log(seen, session, step);
  if (!options_.view.empty() && frames_ % options_.view_every == 0) Draw(session, step);
  ++frames_;
}

bool Diagnosis::HasRoom() {
  if (full_ || options_.most_log_bytes == 0 || log_->bytes() < options_.most_log_bytes) {
    return !full_;
  }
  full_ = true;
  const auto text = fmt::format("all later frames: the log may have {:.1f} MB",
                                static_cast<double>(options_.most_log_bytes) / 1e6);
  log_->Put({.events = {recorder_.Note("dropped", text)}}, options_.patient);
  return false;
}

void Diagnosis::Log(const RunFrame& seen, const ReplaySession& session, const ReplayStep& step) {
  RecordedFrame recorded = recorder_.Add(seen, step);
  if (!HasRoom()) return;
  RunMoment moment{.events = std::move(recorded.events),
                   .stamp = seen.stamp,
                   .row = recorded.row,
                   .odometry = seen.odometry};
  if (options_.picture_every_s > 0.0) {
    moment.picture = *session.picture();
    moment.features = session.ViewFeatures(step);
  }
  log_->Put(std::move(moment), options_.patient);
}

void Diagnosis::Draw(const ReplaySession& session, const ReplayStep& step) {
  if (!view_result_) return;  // one message is enough
  const auto file = options_.view / fmt::format("{:06}.png", frames_);
  view_result_ =
      image::WritePng(DrawFrameView(*session.picture(), step, session.ViewFeatures(step)), file);
}

void Diagnosis::Note(const std::string& what, const std::string& text) {
  if (!begun_ || full_ || !log_) return;
  log_->Put({.events = {recorder_.Note(what, text)}}, options_.patient);
}

Result<void> Diagnosis::End(const std::string& state, const std::string& reason) {
  if (!log_) return view_result_;
  // A run that found no route has a log as well, which says why.
  if (!begun_) Begin({});
  if (auto closed = log_->Close({.events = {recorder_.End(state, reason)}}); !closed) return closed;
  return view_result_;
}

}  // namespace trailcast::agent
