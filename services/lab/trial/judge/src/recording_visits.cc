#include "services/lab/trial/judge/src/recording_visits.h"

#include <string>

#include "services/lab/trial/judge/src/recording_view.h"
#include "services/lab/trial/refresh_taught.h"
#include "services/lab/trial/trial_teach.h"
#include "services/refresh/successor.h"

namespace trailcast::trial {
namespace {

// Returns the outcome of one visit, for people.
Result<std::string> Visit(const agent::RecordedRun& run, const Disturbance& disturbance,
                          const RecordingOptions& options,
                          const std::function<void(double share)>& on_progress,
                          TaughtRoute& route) {
  auto view = RecordingView::Open(run, disturbance, {}, options.seed);
  if (!view) return tl::unexpected(view.error());
  auto session = OpenSession(
      route, {.method = options.method, .anywhere = options.anywhere, .take_experience = true});
  if (!session) return tl::unexpected(session.error());
  const double all = static_cast<double>(view->order().size());
  agent::ReplayStep last;
  for (double frames = 1.0;; ++frames) {
    const auto seen = view->Next();
    if (!seen) return tl::unexpected(seen.error());
    if (!*seen) break;
    auto step = session->Observe(**seen);
    if (!step) return step.error().message;
    last = std::move(*step);
    on_progress(frames / all);
  }
  std::string news;
  for (const std::string& each : view->TakeNews()) news += fmt::format("; {}", each);
  const auto met = session->TakeVisit();
  if (!met) return fmt::format("it ends {}: {}{}", agent::ToString(last.state), last.reason, news);
  const auto refreshed = RefreshTaught(*met, route);
  if (!refreshed && refreshed.error().code == ErrorCode::kUnavailable) {
    return refreshed.error().message;
  }
  if (!refreshed) return tl::unexpected(refreshed.error());
  return fmt::format("{}; now {} bytes{}", refresh::Describe(*refreshed), route.info.bytes, news);
}

}  // namespace

Result<void> VisitRoute(const RecordingPair& pair, const RecordingOptions& options,
                        const std::function<void(double share)>& on_progress,
                        TaughtRecording& taught) {
  const auto disturbance = ParseDisturbance(pair.visits_disturbance);
  if (!disturbance) return tl::unexpected(disturbance.error());
  const auto all = static_cast<double>(pair.visits.size());
  for (const agent::RecordedRun& run : pair.visits) {
    if (!taught.route) return {};
    const auto done = static_cast<double>(taught.visits.size());
    auto visit = Visit(
        run, *disturbance, options, [&](double share) { on_progress((done + share) / all); },
        *taught.route);
    if (!visit) return Wrap(visit.error(), "visiting with " + run.frames.string());
    taught.visits.push_back(
        fmt::format("{} visits {}: {}", run.frames.filename().string(), pair.teach_name, *visit));
  }
  return {};
}

}  // namespace trailcast::trial
