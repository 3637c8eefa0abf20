#include "agent/simulated_device.h"

#include <spdlog/spdlog.h>

#include <cmath>
#include <utility>
#include <vector>

#include "agent/camera_file.h"
#include "agent/text_file.h"
#include "services/sim/indoor_world.h"
#include "services/sim/judge.h"
#include "services/sim/load_world.h"
#include "services/sim/path.h"
#include "services/sim/path_follow_driver.h"
#include "services/sim/simulated_robot.h"

namespace trailcast::agent {
namespace {

constexpr const char* kIndoor = "indoor";

Result<std::shared_ptr<const sim::World>> LoadFile(const SimulatedRun& run) {
  auto up = sim::ParseUpAxis(run.up);
  if (!up) return tl::unexpected(up.error());
  auto ground = sim::ParseGroundMode(run.ground);
  if (!ground) return tl::unexpected(ground.error());
  auto world = sim::LoadWorld({run.world, *up, run.scale, *ground});
  if (!world) {
    return Fail(world.error().code, "{} (built-in worlds: {})", world.error().message, kIndoor);
  }
  for (const std::string& warning : (*world)->warnings()) spdlog::warn("{}", warning);
  return world;
}

Result<sim::BuiltInWorld> OpenPlace(const SimulatedRun& run) {
  sim::BuiltInWorld place;
  if (run.world == kIndoor) {
    auto built = sim::MakeIndoorWorld();
    if (!built) return built;
    place = std::move(*built);
  } else if (run.path.empty()) {
    return Fail(ErrorCode::kInvalidArgument,
                "the world {} has no path of its own: give --path (built-in worlds: {})", run.world,
                kIndoor);
  } else {
    auto world = LoadFile(run);
    if (!world) return tl::unexpected(world.error());
    place.world = std::move(*world);
  }
  if (run.path.empty()) return place;
  auto path = sim::ReadPath(run.path);
  if (!path) return tl::unexpected(path.error());
  place.path = std::move(*path);
  return place;
}

struct TruePose {
  SensorTime stamp{};
  motion::Pose2 pose;
};

}  // namespace

struct SimulatedDevice::State {
  std::string camera;
  std::unique_ptr<sim::SimulatedRobot> robot;
  std::optional<sim::PathFollowDriver> operator_;  // the scout's
  sim::Polyline path;
  double along_m = 0.0;  // the scout's place on it
  motion::VelocityCommand command;
  std::vector<TruePose> truth;

  [[nodiscard]] motion::Pose2 Pose() { return sim::Judge(*robot).true_pose(); }
};

SimulatedDevice::SimulatedDevice(std::unique_ptr<State> state) : state_(std::move(state)) {}
SimulatedDevice::~SimulatedDevice() = default;

Result<std::unique_ptr<SimulatedDevice>> SimulatedDevice::Open(const SimulatedRun& run) {
  auto camera = CameraFromWord(run.camera);
  if (!camera) return tl::unexpected(camera.error());
  auto place = OpenPlace(run);
  if (!place) return tl::unexpected(place.error());
  sim::SimulatedRobotOptions options;
  options.camera = *camera;
  options.start = sim::StartPose(place->path.points);
  options.start_z_max_m = place->path.z_max_m;
  if (run.drives_itself) options.disturbances = sim::Disturbances::ForScout();
  options.seed = run.seed;
  auto robot = sim::SimulatedRobot::Create(place->world, options);
  if (!robot) return tl::unexpected(robot.error());
  auto state = std::make_unique<State>();
  state->camera = fmt::format("{} {}x{}", camera->name, camera->width, camera->height);
  state->robot = std::move(*robot);
  state->path = std::move(place->path.points);
  if (run.drives_itself) {
    sim::DriverOptions driver;
    driver.speed_mps = run.speed_mps;
    state->operator_.emplace(state->path, driver);
  }
  return std::unique_ptr<SimulatedDevice>(new SimulatedDevice(std::move(state)));
}

Result<std::optional<Observation>> SimulatedDevice::Next() {
  State& s = *state_;
  if (s.operator_ && !s.truth.empty()) {
    s.command = s.operator_->Command(s.Pose());
    if (s.operator_->arrived()) return std::nullopt;
  }
  sim::Observation seen = s.robot->Step(s.command);
  s.truth.push_back({seen.stamp, s.Pose()});
  // Looked for near where it was: a loop passes some places twice.
  s.along_m =
      sim::Nearest(s.path, motion::Position(s.truth.back().pose), s.along_m - 1.0, s.along_m + 2.0)
          .along_m;
  return Observation{seen.stamp, std::move(seen.image), seen.odometry};
}

Result<void> SimulatedDevice::Drive(const motion::VelocityCommand& command) {
  if (!state_->operator_) state_->command = command;
  return {};
}

std::string SimulatedDevice::camera() const { return state_->camera; }

std::optional<double> SimulatedDevice::drive_progress() const {
  if (!state_->operator_) return std::nullopt;
  return state_->along_m / sim::Length(state_->path);
}

Result<void> SimulatedDevice::WriteTruth(const std::filesystem::path& file) const {
  std::string text = "t_s,x_m,y_m,heading_rad\n";
  for (const TruePose& row : state_->truth) {
    text += fmt::format("{:.4f},{:.4f},{:.4f},{:.5f}\n", Seconds(row.stamp), row.pose.x_m,
                        row.pose.y_m, row.pose.heading_rad);
  }
  return WriteTextFile(file, text);
}

}  // namespace trailcast::agent
