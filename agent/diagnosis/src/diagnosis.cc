#include "agent/diagnosis/diagnosis.h"

#include <fmt/format.h>

#include "agent/diagnosis/run_log_format.h"
#include "agent/diagnosis/src/frame_view.h"
#include "agent/diagnosis/src/run_mcap_file.h"
#include "services/image/files.h"

namespace trailcast::agent {

Diagnosis::Diagnosis(DiagnosisOptions options) : options_(std::move(options)) {}
Diagnosis::~Diagnosis() = default;
Diagnosis::Diagnosis(Diagnosis&&) noexcept = default;
Diagnosis& Diagnosis::operator=(Diagnosis&&) noexcept = default;

Result<void> Diagnosis::OpenLog() {
  if (options_.log.extension() == ".mcap") {
    return RunMcapFile::Create(options_.log, options_.picture_every_s)
        .map([this](std::unique_ptr<RunMcapFile> file) { mcap_ = std::move(file); });
  }
  return RunLogFile::Create(options_.log).map([this](std::unique_ptr<RunLogFile> file) {
    file_ = std::move(file);
  });
}

Result<Diagnosis> Diagnosis::Open(const DiagnosisOptions& options) {
  Diagnosis diagnosis(options);
  if (!options.log.empty()) {
    if (auto opened = diagnosis.OpenLog(); !opened) return tl::unexpected(opened.error());
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
  std::string text = FirstLine() + HeaderText(header);
  if (file_) file_->Put(std::move(text));
  if (mcap_) mcap_->Put({.text = std::move(text)}, options_.patient);
  begun_ = true;
}

void Diagnosis::Add(const RunFrame& seen, const ReplaySession& session, const ReplayStep& step) {
  if (file_ || mcap_) Log(seen, session, step);
  if (!options_.view.empty() && frames_ % options_.view_every == 0) Draw(session, step);
  ++frames_;
}

bool Diagnosis::HasRoom() {
  const std::uint64_t bytes = file_ ? file_->bytes() : mcap_->bytes();
  if (full_ || options_.most_log_bytes == 0 || bytes < options_.most_log_bytes) return !full_;
  full_ = true;
  std::string text = fmt::format("# dropped all later frames: the log may have {:.1f} MB\n",
                                 static_cast<double>(options_.most_log_bytes) / 1e6);
  if (file_) file_->Put(std::move(text));
  if (mcap_) mcap_->Put({.text = std::move(text)}, options_.patient);
  return false;
}

void Diagnosis::Log(const RunFrame& seen, const ReplaySession& session, const ReplayStep& step) {
  RecordedFrame recorded = recorder_.Add(seen, step);
  if (!HasRoom()) return;
  std::string text = RowText(recorded.row);
  for (const RunEvent& event : recorded.events) text += EventText(event);
  if (file_) file_->Put(std::move(text));
  if (mcap_) {
    mcap_->Put({.text = std::move(text),
                .events = std::move(recorded.events),
                .stamp = seen.stamp,
                .row = recorded.row,
                .odometry = seen.odometry,
                .picture = *session.picture(),
                .features = session.ViewFeatures(step)},
               options_.patient);
  }
}

void Diagnosis::Draw(const ReplaySession& session, const ReplayStep& step) {
  if (!view_result_) return;  // one message is enough
  const auto file = options_.view / fmt::format("{:06}.png", frames_);
  view_result_ =
      image::WritePng(DrawFrameView(*session.picture(), step, session.ViewFeatures(step)), file);
}

void Diagnosis::Note(const std::string& what, const std::string& text) {
  if (!begun_ || full_) return;
  const RunEvent event = recorder_.Note(what, text);
  if (file_) file_->Put(EventText(event));
  if (mcap_) mcap_->Put({.text = EventText(event), .events = {event}}, options_.patient);
}

Result<void> Diagnosis::End(const std::string& state, const std::string& reason) {
  if (!file_ && !mcap_) return view_result_;
  // A run that found no route has a log all the same: it says why.
  if (!begun_) Begin({});
  const RunEvent event = recorder_.End(state, reason);
  auto closed = file_ ? file_->Close([&event] { return EventText(event); })
                      : mcap_->Close({.text = EventText(event), .events = {event}});
  if (!closed) return closed;
  return view_result_;
}

}  // namespace trailcast::agent
