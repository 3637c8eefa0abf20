#include "services/lab/trial/judge/taught_recording.h"

#include <utility>

namespace trailcast::trial {

Result<TaughtRecording> TeachRecording(const agent::RecordedRun& run,
                                       const agent::TeachOptions& options,
                                       const std::function<void(double share)>& on_progress) {
  auto device = agent::RecordedDevice::Open(run);
  if (!device) return tl::unexpected(device.error());
  RouteRecorder recorder(run.frames.string(), (*device)->camera(), options);
  TaughtRecording taught{Fail(ErrorCode::kUnavailable, "no frames"), {}, 0, {}};
  for (;; ++taught.frames) {
    const auto seen = (*device)->Next();
    if (!seen) return tl::unexpected(seen.error());
    if (!*seen) break;
    if (const auto observed = recorder.Observe(**seen); !observed) {
      return Wrap(observed.error(), fmt::format("frame {}", taught.frames));
    }
    on_progress((*device)->drive_progress().value_or(0.0));
  }
  taught.route = recorder.Finish();
  taught.spans = recorder.spans();
  return taught;
}

}  // namespace trailcast::trial
