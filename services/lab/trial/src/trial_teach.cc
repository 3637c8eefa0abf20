#include "services/lab/trial/trial_teach.h"

#include <memory>
#include <optional>
#include <utility>

#include "agent/session/teach_session.h"
#include "services/lab/sim/core/judge.h"
#include "services/lab/sim/core/path_follow_driver.h"
#include "services/lab/sim/core/simulated_robot.h"
#include "services/lab/trial/src/standstill_watch.h"
#include "services/route/backwards.h"
#include "services/route/digest.h"

namespace trailcast::trial {
namespace {

constexpr int kProgressEvery = 15;  // frames

Result<sim::SimulatedRobotOptions> ScoutOptions(const TrialSetup& setup,
                                                const sim::CameraModel& camera,
                                                std::uint64_t seed) {
  sim::SimulatedRobotOptions options;
  options.camera = camera;
  options.start = sim::StartPose(setup.path);
  options.start_z_max_m = setup.path.z_max_m;
  options.disturbances = sim::Disturbances::ForScout();
  options.disturbances.slip = setup.follower.slip;  // because it is the same ground
  options.seed = seed;
  auto actors = setup.actors(sim::Role::kScout, seed);
  if (!actors) return tl::unexpected(actors.error());
  options.actors = std::move(*actors);
  return options;
}

class Teaching {
 public:
  Teaching(const TrialSetup& setup, const sim::CameraModel& camera,
           const std::vector<agent::TeachOptions>& teachings, sim::SimulatedRobot& robot)
      : robot_(robot),
        truth_(robot),
        has_odometry_(setup.scout_has_odometry),
        driver_(setup.path.points,
                {.speed_mps = setup.speed_mps, .shunts_from = setup.path.shunts_from}) {
    for (const auto& options : teachings) {
      recorders_.emplace_back(setup.scenario, camera.name, options);
    }
  }

  // Does one frame. Returns false when the drive is over.
  Result<bool> Step() {
    sim::Observation frame = robot_.Step(command_);
    taught_.path.Add(motion::Position(truth_.true_pose()));
    agent::Observation seen{frame.stamp, std::move(frame.image), frame.odometry};
    if (!has_odometry_) seen.odometry.reset();
    for (RouteRecorder& recorder : recorders_) {
      if (auto kept = recorder.Observe(seen); !kept) return tl::unexpected(kept.error());
    }
    taught_.duration_s = Seconds(seen.stamp);
    const bool over = driver_.arrived() && truth_.true_velocity() == motion::VelocityCommand{};
    command_ = driver_.Command(truth_.true_pose());
    return !over;
  }

  Result<Taught> Finish() {
    for (RouteRecorder& recorder : recorders_) {
      auto route = recorder.Finish();
      if (!route) return tl::unexpected(route.error());
      taught_.routes.push_back(std::move(*route));
    }
    return std::move(taught_);
  }

  [[nodiscard]] double time_s() const { return taught_.duration_s; }
  [[nodiscard]] const motion::Pose2& true_pose() const { return truth_.true_pose(); }
  // Returns the share of the path up to the nearest place on it.
  [[nodiscard]] double share() const {
    return sim::Nearest(driver_.path(), motion::Position(true_pose())).along_m /
           sim::Length(driver_.path());
  }

 private:
  sim::SimulatedRobot& robot_;
  sim::Judge truth_;
  bool has_odometry_;
  sim::PathFollowDriver driver_;
  std::vector<RouteRecorder> recorders_;
  motion::VelocityCommand command_;
  Taught taught_;
};

}  // namespace

Result<Taught> TeachOnce(const TrialSetup& setup, const sim::CameraModel& camera,
                         const std::vector<agent::TeachOptions>& teachings, std::uint64_t seed,
                         const std::function<bool(double share)>& on_progress) {
  const auto options = ScoutOptions(setup, camera, seed);
  if (!options) return Wrap(options.error(), "the scout");
  const auto robot = sim::SimulatedRobot::Create(setup.world, *options);
  if (!robot) return Wrap(robot.error(), "the scout");
  Teaching teaching(setup, camera, teachings, **robot);
  StandstillWatch standstill;
  for (int frame = 0;; ++frame) {
    const Result<bool> more = teaching.Step();
    if (!more) return Wrap(more.error(), "the scout");
    if (!*more) return teaching.Finish();
    const motion::Pose2& pose = teaching.true_pose();
    if (standstill.Stuck(motion::Position(pose), teaching.time_s())) {
      return Fail(
          ErrorCode::kUnavailable,
          "the scout gets no further than ({:.2f}, {:.2f}) along the path, at {:.0f} % of it: "
          "does something stand in the way?",
          pose.x_m, pose.y_m, 100.0 * teaching.share());
    }
    if (frame % kProgressEvery == 0 && !on_progress(teaching.share())) {
      return Fail(ErrorCode::kUnavailable, "interrupted");
    }
  }
}

Result<agent::ReplaySession> OpenSession(const TaughtRoute& taught,
                                         const agent::ReplayMethodOptions& options,
                                         bool backwards) {
  std::vector<route::Segment> segments;
  for (const route::SegmentPiece& piece : taught.pieces) {
    auto segment = route::Open(piece);
    if (!segment) return tl::unexpected(segment.error());
    segments.push_back(*std::move(segment));
  }
  if (backwards) {
    auto turned = route::DrivenBackwards(segments);
    if (!turned) return tl::unexpected(turned.error());
    segments = *std::move(turned);
  }
  agent::ReplaySession session(options, taught.info);
  for (route::Segment& segment : segments) {
    const auto added = session.AddSegment(std::move(segment));
    if (!added) return tl::unexpected(added.error());
  }
  session.MarkComplete();
  return session;
}

}  // namespace trailcast::trial
