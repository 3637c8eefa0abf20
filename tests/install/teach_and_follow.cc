// Teaches a route with one recording, follows it with another: folders of pictures.
//   teach_and_follow TEACH REPLAY
#include <agent/session/replay_session.h>
#include <agent/session/teach_session.h>
#include <services/image/files.h>
#include <services/vision/picture_intake.h>

#include <cstdio>
#include <utility>
#include <vector>

using namespace trailcast;  // NOLINT(google-build-using-namespace): an example

template <typename Use>
void ForEachFrame(const char* folder, const Use& use) {
  const auto frames = image::FrameSequence::Open(folder).value();
  agent::Observation seen;
  for (; auto frame = frames->Next().value(); seen.stamp += std::chrono::milliseconds(50)) {
    seen.image = std::move(*frame);
    use(seen);
  }
}

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  agent::TeachSession scout;
  route::RouteInfo info;
  std::vector<route::Segment> segments;
  ForEachFrame(argv[1], [&](const agent::Observation& seen) {
    info.image_width_px = vision::WorkingSize({seen.image.width, seen.image.height}).width;
    if (auto ended = scout.Observe(seen).value().finished) segments.push_back(std::move(*ended));
  });
  if (auto last = scout.Finish()) segments.push_back(std::move(*last));

  agent::ReplaySession follower({}, info);
  for (route::Segment& segment : segments) {
    if (!follower.AddSegment(std::move(segment))) return 1;
  }
  follower.MarkComplete();
  agent::ReplayStep step;
  ForEachFrame(argv[2],
               [&](const agent::Observation& seen) { step = follower.Observe(seen).value(); });
  std::printf("%zu segments; %s\n", segments.size(), agent::ToString(step.state));
}
