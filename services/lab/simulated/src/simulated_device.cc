#include "services/lab/simulated/simulated_device.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <fstream>
#include <thread>
#include <utility>
#include <vector>

#include "services/lab/sim/core/judge.h"
#include "services/lab/sim/core/path_follow_driver.h"
#include "services/lab/sim/core/simulated_robot.h"
#include "services/lab/sim/places/place.h"
#include "services/lab/simulated/body_imu.h"
#include "services/lab/simulated/camera_file.h"

namespace trailcast::agent {
namespace {

using std::chrono::steady_clock;

// The height of a small robot's scanner above the ground.
constexpr double kScanner_m = 0.2;
constexpr double kAtCharger_m = 0.5;

}  // namespace

struct SimulatedDevice::State {
  std::string camera;
  std::shared_ptr<const sim::World> world;
  std::unique_ptr<sim::SimulatedRobot> robot;
  std::optional<sim::PathFollowDriver> operator_;  // the scout's
  std::optional<sim::DriverOptions> driver;        // drives it on request by hand
  sim::Polyline path;                              // the driver's path
  bool stays_at_end = false;
  steady_clock::duration step{0};  // for real time
  steady_clock::time_point due{};  // when the next step is
  motion::VelocityCommand command;
  BodyImu imu;
  double battery_s = 0.0;  // how long it lasts; with 0 it reports none
  std::atomic<double> charge = 1.0;
  std::optional<Charger> charger;
  double charged_at_s = 0.0;          // when `charge` was so
  bool begun = false;                 // there was a frame
  std::optional<CarriedOff> carried;  // still to come
  double driven_m = 0.0;
  Eigen::Vector2d was_m = Eigen::Vector2d::Zero();
  std::filesystem::path truth_file;
  std::ofstream truth;  // the file of true poses, if there is one

  void AwaitNext();
  void Drain(double now_s, const motion::Pose2& pose);
  [[nodiscard]] Observation Note(sim::Observation seen);
  void CarryOff(const motion::Pose2& from);
  [[nodiscard]] motion::Pose2 Pose() { return sim::Judge(*robot).true_pose(); }
};

SimulatedDevice::SimulatedDevice(std::unique_ptr<State> state) : state_(std::move(state)) {}
SimulatedDevice::~SimulatedDevice() = default;

Result<std::unique_ptr<SimulatedDevice>> SimulatedDevice::Open(const SimulatedRun& run) {
  auto camera = CameraFromWord(run.camera);
  if (!camera) return tl::unexpected(camera.error());
  auto place = sim::OpenPlace(
      {run.place.world, run.place.path, run.place.up, run.place.scale, run.place.ground});
  if (!place) return tl::unexpected(place.error());
  for (const std::string& warning : place->world->warnings()) spdlog::warn("{}", warning);
  sim::SimulatedRobotOptions options;
  options.camera = *camera;
  options.start = sim::StartPose(place->path);
  options.start_z_max_m = place->path.z_max_m;
  if (run.drives_itself) options.disturbances = sim::Disturbances::ForScout();
  options.disturbances.slip = place->slip;
  options.seed = run.seed;
  options.rate_hz = run.rate_hz;
  options.body.turn_radius_m = run.turn_radius_m;
  for (const RoughGround& rough : run.rough) {
    options.rough.push_back({{rough.x_m, rough.y_m}, rough.radius_m, rough.height_m});
  }
  auto robot = sim::SimulatedRobot::Create(place->world, options);
  if (!robot) return tl::unexpected(robot.error());
  auto state = std::make_unique<State>();
  state->stays_at_end = run.stays_at_end;
  if (run.in_real_time) {
    state->step = std::chrono::duration_cast<steady_clock::duration>(
        std::chrono::duration<double>(1.0 / run.rate_hz));
  }
  state->battery_s = 60.0 * run.battery_minutes;
  state->charger = run.charger;
  state->carried = run.carried;
  state->camera = fmt::format("{} {}x{}", camera->name, camera->width, camera->height);
  state->world = place->world;
  state->robot = std::move(*robot);
  if (!run.truth.empty()) {
    state->truth_file = run.truth;
    state->truth.open(run.truth);
    state->truth << "t_s,x_m,y_m,heading_rad\n" << std::flush;
  }
  sim::DriverOptions driver;
  driver.shunts_from = place->path.shunts_from;
  driver.speed_mps = run.speed_mps > 0.0 ? run.speed_mps : place->speed_mps;
  if (run.drives_itself) state->operator_.emplace(place->path.points, driver);
  if (run.has_driver) state->driver = driver;
  state->path = std::move(place->path.points);
  std::unique_ptr<SimulatedDevice> device(new SimulatedDevice(std::move(state)));
  if (auto can = device->TruthWritten(); !can) return tl::unexpected(can.error());
  return device;
}

// A delay of more than a step is not made up for: while nobody asked for frames, no time has passed
// there.
void SimulatedDevice::State::AwaitNext() {
  if (step.count() == 0) return;
  std::this_thread::sleep_until(due);
  const auto now = steady_clock::now();
  due = (now - due < step ? due : now) + step;
}

Result<std::optional<Observation>> SimulatedDevice::Next() {
  State& s = *state_;
  s.AwaitNext();
  if (s.operator_ && s.begun) {
    s.command = s.operator_->Command(s.Pose());
    if (s.operator_->arrived() && !s.stays_at_end) return std::nullopt;
  }
  return s.Note(s.robot->Step(s.command));
}

void SimulatedDevice::ByHand(bool begins) {
  State& s = *state_;
  if (!s.driver) return;
  s.operator_.reset();
  s.command = {};
  if (begins) s.operator_.emplace(s.path, *s.driver);
}

Result<image::GrayImage> SimulatedDevice::Look() {
  return state_->Note(state_->robot->Step({})).image;
}

Observation SimulatedDevice::NextBlind() {
  State& s = *state_;
  if (s.operator_ && s.begun) s.command = s.operator_->Command(s.Pose());
  return s.Note(s.robot->StepBlind(s.command));
}

// This happens before the next frame.
void SimulatedDevice::State::CarryOff(const motion::Pose2& from) {
  driven_m += begun ? (motion::Position(from) - was_m).norm() : 0.0;
  was_m = motion::Position(from);
  if (!carried || driven_m < carried->after_m) return;
  spdlog::warn("somebody carries the robot off, from {:.2f},{:.2f} to {:.2f},{:.2f}", from.x_m,
               from.y_m, carried->to.x_m, carried->to.y_m);
  sim::Judge(*robot).Carry(carried->to);
  was_m = motion::Position(carried->to);
  imu = {};
  carried.reset();
}

void SimulatedDevice::State::Drain(double now_s, const motion::Pose2& pose) {
  if (battery_s <= 0.0) return;
  const double passed_s = now_s - std::exchange(charged_at_s, now_s);
  const bool charges =
      charger &&
      (motion::Position(pose) - Eigen::Vector2d(charger->x_m, charger->y_m)).norm() <= kAtCharger_m;
  const double gained = charges ? passed_s / (60.0 * charger->minutes) : -passed_s / battery_s;
  charge = std::clamp(charge + gained, 0.0, 1.0);
}

Observation SimulatedDevice::State::Note(sim::Observation seen) {
  const motion::Pose2 pose = Pose();
  Drain(Seconds(seen.stamp), pose);
  // Somebody who reads the file meanwhile gets whole lines.
  if (truth.is_open()) {
    truth << fmt::format("{:.4f},{:.4f},{:.4f},{:.5f}\n", Seconds(seen.stamp), pose.x_m, pose.y_m,
                         pose.heading_rad)
          << std::flush;
  }
  const motion::ImuSample felt = imu.Feel(seen.stamp, sim::Judge(*robot).WorldFromBody());
  CarryOff(pose);
  begun = true;
  return {seen.stamp, std::move(seen.image), seen.odometry, {}, {felt}};
}

motion::Scan SimulatedDevice::Scan(const std::vector<Pillar>& pillars) const {
  const sim::Judge truth(*state_->robot);
  return LookAround(*state_->world, truth.stage(),
                    truth.WorldFromBody() * Eigen::Translation3d(0.0, 0.0, kScanner_m), pillars);
}

motion::ConeRange SimulatedDevice::Range(const motion::Pose2& mount,
                                         const std::vector<Pillar>& pillars) const {
  const sim::Judge truth(*state_->robot);
  const Eigen::Isometry3d body_from_sensor =
      Eigen::Translation3d(mount.x_m, mount.y_m, kScanner_m) *
      Eigen::AngleAxisd(mount.heading_rad, Eigen::Vector3d::UnitZ());
  return LookAhead(*state_->world, truth.stage(), truth.WorldFromBody() * body_from_sensor,
                   pillars);
}

void SimulatedDevice::SetGrip(double left, double right) { state_->robot->SetGrip(left, right); }

Result<void> SimulatedDevice::Drive(const motion::VelocityCommand& command) {
  if (!state_->operator_) state_->command = command;
  return {};
}

std::string SimulatedDevice::camera() const { return state_->camera; }

std::optional<double> SimulatedDevice::drive_progress() const {
  if (!state_->operator_) return std::nullopt;
  return state_->operator_->progress();
}

std::optional<std::uint8_t> SimulatedDevice::battery_percent() const {
  if (state_->battery_s <= 0.0) return std::nullopt;
  return static_cast<std::uint8_t>(std::lround(100.0 * state_->charge));
}

Result<void> SimulatedDevice::TruthWritten() const {
  const State& s = *state_;
  if (s.truth_file.empty() || s.truth.good()) return {};
  return Fail(ErrorCode::kUnavailable,
              "cannot write {}: is its folder there, and the disk not full?",
              s.truth_file.string());
}

}  // namespace trailcast::agent
