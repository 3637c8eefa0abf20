#include "services/lab/trial/flaws.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "services/lab/sim/core/random.h"

namespace trailcast::trial {
namespace {

using agent::RobotFault;
using Kind = RobotFault::Kind;

constexpr double kEarliest = 0.25;  // share of the drive
constexpr double kLatest = 0.65;

struct Drawing {
  double drive_s;
  sim::Random random;

  [[nodiscard]] double Sign() { return random.Uniform() < 0.5 ? -1.0 : 1.0; }
  [[nodiscard]] double Moment_s() { return drive_s * random.Uniform(kEarliest, kLatest); }
};

struct KnownFlaw {
  Flaw flaw;
  std::function<void(RobotFlaws&, Drawing&)> draw;
};

void MoveAhead(RobotFlaws& robot, Drawing& draw) {
  robot.camera.ahead_m += draw.random.Uniform(0.1, 0.6);
}

void Roll(RobotFlaws& robot, double degrees) {
  robot.camera.roll_deg = std::remainder(robot.camera.roll_deg + degrees, 360.0);
}

void LoseOdometry(RobotFlaws& robot, Drawing& draw) {
  robot.faults.push_back({Kind::kOdometryRestarts, {draw.Moment_s()}});
  robot.faults.push_back({Kind::kOdometryJumps, {draw.Moment_s()}});
}

void LoseClocks(RobotFlaws& robot, Drawing& draw) {
  robot.faults.push_back({Kind::kCameraClockBack, {draw.Moment_s()}});
  robot.faults.push_back({Kind::kOdometryClockBack, {draw.Moment_s()}});
  robot.faults.push_back({Kind::kCameraStampsStand, {draw.Moment_s(), 2.0}});
}

const std::vector<KnownFlaw>& KnownFlaws() {
  static const std::vector<KnownFlaw> all = {
      {{"upside-down", "the camera hangs upside down, and the agent is told"},
       [](RobotFlaws& robot, Drawing&) {
         Roll(robot, 180.0);
         robot.told_roll_deg = 180.0;
       }},
      {{"crooked", "the camera is mounted with up to 5 degrees of roll"},
       [](RobotFlaws& robot, Drawing& draw) { Roll(robot, draw.random.Uniform(-5.0, 5.0)); }},
      {{"ahead", "the camera sits 0.1 to 0.6 m ahead of the axle"}, MoveAhead},
      {{"ahead-told", "the same, and the agent is told how far"},
       [](RobotFlaws& robot, Drawing& draw) {
         MoveAhead(robot, draw);
         robot.told_ahead_m = robot.camera.ahead_m;
       }},
      {{"off-centre", "the lens looks 5 % of the picture's width off its middle"},
       [](RobotFlaws& robot, Drawing& draw) {
         robot.camera.centre_u = 0.05 * draw.Sign();
         robot.camera.centre_v = 0.05 * draw.Sign();
       }},
      {{"knocked", "somebody turns the camera by 5 degrees on the way"},
       [](RobotFlaws& robot, Drawing& draw) {
         robot.camera.knock_yaw_deg = 5.0 * draw.Sign();
         robot.camera.knock_at_s = draw.Moment_s();
       }},
      {{"exposure", "brightness wanders to twice and to half within 2 to 8 seconds"},
       [](RobotFlaws& robot, Drawing& draw) {
         robot.camera.exposure_swing = 2.0;
         robot.camera.exposure_period_s = draw.random.Uniform(2.0, 8.0);
       }},
      {{"rolling-shutter", "the camera reads its rows within 0.03 s, one after the other"},
       [](RobotFlaws& robot, Drawing&) { robot.camera.readout_s = 0.03; }},
      {{"frame-rate", "5 to 30 pictures a second, and a fifth of them lost"},
       [](RobotFlaws& robot, Drawing& draw) {
         robot.timing.picture_rate_hz = 5.0 * std::pow(6.0, draw.random.Uniform());
         robot.timing.dropped = 0.2;
       }},
      {{"late", "pictures come 0.2 s late, and the base obeys as late"},
       [](RobotFlaws& robot, Drawing&) {
         robot.timing.picture_delay_s = 0.2;
         robot.timing.base_delay_s = 0.2;
       }},
      {{"stamps", "stamps of pictures are up to 2 s off those of odometry"},
       [](RobotFlaws& robot, Drawing& draw) {
         robot.timing.stamps_late_s = draw.random.Uniform(-2.0, 2.0);
       }},
      {{"clocks", "both clocks are set back, and the camera's stands for 2 s"}, LoseClocks},
      {{"odometry", "odometry begins anew at zero, and jumps by 2 m"}, LoseOdometry},
      {{"slips", "one wheel spins for a second"},
       [](RobotFlaws& robot, Drawing& draw) {
         robot.faults.push_back({Kind::kWheelSlips, {draw.Moment_s(), 1.0}});
       }},
      {{"stops", "the base stands for a second against its commands"},
       [](RobotFlaws& robot, Drawing& draw) {
         robot.faults.push_back({Kind::kBaseStops, {draw.Moment_s(), 1.0}});
       }},
  };
  return all;
}

// A camera ahead is drawn only once, although there are two flaws with one: with and without
// telling the agent.
void DrawAll(RobotFlaws& robot, Drawing& draw) {
  for (const KnownFlaw& each : KnownFlaws()) {
    if (each.flaw.name != "ahead-told") each.draw(robot, draw);
  }
}

}  // namespace

const std::vector<Flaw>& Flaws() {
  static const std::vector<Flaw> all = [] {
    std::vector<Flaw> flaws;
    for (const KnownFlaw& each : KnownFlaws()) flaws.push_back(each.flaw);
    flaws.push_back({"all", "all of these together, and nothing told but that it is upside down"});
    return flaws;
  }();
  return all;
}

std::vector<std::string> FlawNames() {
  std::vector<std::string> names;
  for (const Flaw& each : Flaws()) names.push_back(each.name);
  return names;
}

Result<void> CheckFlaw(const std::string& name) {
  const std::vector<std::string> names = FlawNames();
  if (name.empty() || std::find(names.begin(), names.end(), name) != names.end()) return {};
  return Fail(ErrorCode::kNotFound, "there is no flaw '{}'; there are: {}", name,
              fmt::join(names, ", "));
}

RobotFlaws DrawFlaws(const std::string& name, const sim::CameraModel& camera, double drive_s,
                     std::uint64_t seed) {
  RobotFlaws robot;
  robot.camera = camera;
  Drawing draw{drive_s, sim::Random(seed, "flaws")};
  if (name == "all") DrawAll(robot, draw);
  for (const KnownFlaw& each : KnownFlaws()) {
    if (each.flaw.name == name) each.draw(robot, draw);
  }
  return robot;
}

}  // namespace trailcast::trial
