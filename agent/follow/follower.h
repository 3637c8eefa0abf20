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

class Glances;

struct FollowerOptions {
  FollowerLinkOptions link;
  HowToFollow how;
  DiagnosisOptions diagnosis;
  // The device is a recording: every frame is looked at, whatever the follower makes of it.
  bool open_loop = false;
  // How far along the route it has arrived; 0: at its end, or, backwards, its beginning. The
  // control loop asks at each frame.
  std::function<double()> end_m = [] { return 0.0; };
  // From followers ahead on the same revision of the route; without `exchange` nobody is heard.
  KeepDistanceOptions keep_distance;
  // A robot that gets no further along the route for so long (by its sensors' time) gives up.
  std::chrono::seconds stuck_after{60};
  Glances* glances = nullptr;  // for those who look through its camera; null: nobody does
  // Asked at each frame, with what is known of the robot's camera: along which route it goes on
  // where this one ends for it; null: along none. Nothing: that is as before.
  using Next = std::optional<std::unique_ptr<NextPath>>;
  std::function<Next(const std::optional<OwnLens>&)> next = {};
};

// How following a route ended.
enum class RunEnd : std::uint8_t {
  kArrived,
  kLost,
  kStuck,      // it got no further
  kRefused,    // the robot cannot drive the route
  kWaiting,    // for more of the route, which did not come
  kRecording,  // what there was to see is over, and the robot was under way
  kStopped,    // by whoever runs it
  kCancelled,  // by an operator
  kFailed,     // ReplayOutcome::error
};

struct ReplayOutcome {
  bool success = false;  // arrived; or a recording was replayed to its end and not lost there
  RunEnd end = RunEnd::kFailed;
  std::string state;           // the same for people: ARRIVED, LOST, STUCK, REFUSED, WAITING, ...
  std::string reason;          // one line for people
  std::optional<Error> error;  // camera, base, store or network failed; what was done until then:
  Summary summary;
  // Of a route that it has arrived on, if it was to take experience: what it met with.
  std::optional<route::RouteInfo> followed;
  std::optional<refresh::Visit> visit;
  std::optional<OwnLens> lens;  // what is known of the robot's camera, for its next run
  // It has arrived, and drives on along this. Whoever drops it has the robot stand.
  std::unique_ptr<NextPath> next;
  Result<void> diagnosed;  // whether log and pictures are complete
  ReplayLog log;
};

// Follows a route with `device` until it arrives, is lost, or `options.link.stop` says so. Frames
// are asked of the device only while there is something to follow. `exchange` may be null: then the
// route comes from `store` alone. The errors: another agent has the name; the log
// cannot be made.
// `begun`: the robot drives along it already, and goes on so.
[[nodiscard]] Result<ReplayOutcome> Replay(RobotDevice& device, const FollowerOptions& options,
                                           std::unique_ptr<store::RouteStore> store,
                                           std::unique_ptr<exchange::RouteExchange> exchange,
                                           std::unique_ptr<NextPath> begun = nullptr);

}  // namespace trailcast::agent
