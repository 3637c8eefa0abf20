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
  std::vector<int> numbers;  // in the recording, for the frames that can be read
  while (true) {
    const auto seen = (*device)->Next();
    if (!seen) return tl::unexpected(seen.error());
    if (!*seen) break;
    if (const auto observed = recorder.Observe(**seen); !observed) {
      return Wrap(observed.error(), fmt::format("frame {}", (*device)->frame()));
    }
    numbers.push_back((*device)->frame());
    on_progress((*device)->drive_progress().value_or(0.0));
  }
  taught.route = recorder.Finish();
  for (const FrameSpan& span : recorder.spans()) {
    taught.spans.push_back({numbers.at(static_cast<std::size_t>(span.first)),
                            numbers.at(static_cast<std::size_t>(span.last))});
  }
  taught.frames = numbers.empty() ? 0 : numbers.back() + 1;
  return taught;
}

}  // namespace trailcast::trial
