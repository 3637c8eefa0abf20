#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "agent/device/device.h"
#include "agent/diagnosis/diagnosis.h"
#include "agent/diagnosis/replay_log.h"
#include "agent/diagnosis/summary.h"
#include "agent/follow/keep_distance.h"
#include "agent/follow/known_path.h"
#include "agent/follow/next_path.h"
#include "agent/link/follower_link.h"
#include "services/refresh/visit.h"

namespace trailcast::agent {

class PhotoRun;
class Snapshots;

struct FollowerOptions {
  FollowerLinkOptions link;
  HowToFollow how;
  DiagnosisOptions diagnosis;
  // The device is a recording, so every frame is looked at, whatever the follower decides.
  bool open_loop = false;
  // Returns how far along the route it has arrived; 0 stands for the route's end or, backwards, its
  // beginning. The control loop calls it at each frame.
  std::function<double()> end_m = [] { return 0.0; };
  // For followers ahead on the same revision of the route. Without `exchange` nobody is heard.
  KeepDistanceOptions keep_distance;
  // A robot that gets no further along the route for so long, by its sensors' time, gives up.
  std::chrono::seconds stuck_after{60};
  Snapshots* snapshots = nullptr;  // for people who look through its camera; may be null
  PhotoRun* photos = nullptr;      // the photos to be taken on the way; null for none
  // Returns the route on which it goes on where this one ends for it, null for none, or nothing for
  // no change. The control loop calls it at each frame with its knowledge of the robot's camera.
  using Next = std::optional<std::unique_ptr<NextPath>>;
  std::function<Next(const std::optional<OwnLens>&)> next = {};
};

// How a run along a route ended.
enum class RunEnd : std::uint8_t {
  kArrived,
  kLost,
  kStuck,      // it got no further
  kRefused,    // the robot cannot drive the route
  kWaiting,    // more of the route did not come
  kRecording,  // the recording ended while the robot was under way
  kStopped,    // by `stop`
  kCancelled,  // by an operator
  kFailed,     // see ReplayOutcome::error
};

struct ReplayOutcome {
  bool success = false;  // it arrived; or a recording was replayed to its end and the robot was not
                         // lost there
  RunEnd end = RunEnd::kFailed;
  std::string state;           // `end` in reports and logs: ARRIVED, LOST, STUCK, REFUSED, ...
  std::string reason;          // one line for people
  std::optional<Error> error;  // why the camera, base, store or network failed; the rest tells what
                               // was done until then
  Summary summary;
  // The visit of a route on which it has arrived, if it was to take experience.
  std::optional<route::RouteInfo> followed;
  std::optional<refresh::Visit> visit;
  std::optional<OwnLens> lens;  // its knowledge of the robot's camera, for the next run
  // The path on which it drives on after it has arrived. Dropping it stops the robot.
  std::unique_ptr<NextPath> next;
  Result<void> diagnosed;  // whether the log and the pictures are complete
  ReplayLog log;
};

// Follows a route with `device` until it arrives, is lost, or `options.link.stop` returns true. It
// asks the device for frames only while there is something to follow. `exchange` may be null; the
// route then comes from `store` alone. `begun` is a path on which the robot drives already. Errors:
// another agent has the name; the log cannot be made.
[[nodiscard]] Result<ReplayOutcome> Replay(RobotDevice& device, const FollowerOptions& options,
                                           std::unique_ptr<store::RouteStore> store,
                                           std::unique_ptr<exchange::RouteExchange> exchange,
                                           std::unique_ptr<NextPath> begun = nullptr);

}  // namespace trailcast::agent
