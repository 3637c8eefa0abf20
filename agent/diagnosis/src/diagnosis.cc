#include "agent/diagnosis/diagnosis.h"

#include <fmt/format.h>

#include "agent/diagnosis/src/frame_view.h"
#include "services/image/files.h"

namespace trailcast::agent {

Result<Diagnosis> Diagnosis::Open(const DiagnosisOptions& options) {
  Diagnosis diagnosis(options);
  if (!options.log.empty()) {
    auto file = RunLogFile::Create(options.log);
    if (!file) return tl::unexpected(file.error());
    diagnosis.file_ = std::move(*file);
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
  if (file_) file_->Put(recorder_.Begin(facts));
  begun_ = true;
}

void Diagnosis::Add(const RunFrame& seen, const image::GrayImage& frame,
                    const ReplaySession& session, const ReplayStep& step) {
  if (file_) file_->Put(recorder_.Add(seen, step));
  if (!options_.view.empty()) {
    const image::GrayImage& unrolled = unroller_.Unroll(frame);
    if (frames_ % options_.view_every == 0) Draw(unrolled, session, step);
  }
  ++frames_;
}

void Diagnosis::Draw(const image::GrayImage& frame, const ReplaySession& session,
                     const ReplayStep& step) {
  if (!view_result_) return;  // one message is enough
  const auto file = options_.view / fmt::format("{:06}.png", frames_);
  view_result_ = image::WritePng(DrawFrameView(frame, step, session.ViewFeatures(step)), file);
}

void Diagnosis::Note(const std::string& what, const std::string& text) {
  if (file_ && begun_) file_->Put(recorder_.Note(what, text));
}

Result<void> Diagnosis::End(const std::string& state, const std::string& reason) {
  if (!file_) return view_result_;
  // A run that found no route has a log all the same: it says why.
  if (!begun_) Begin({});
  file_->Put(recorder_.End(state, reason));
  auto closed = file_->Close();
  if (!closed) return closed;
  return view_result_;
}

}  // namespace trailcast::agent
