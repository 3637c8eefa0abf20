#include <benchmark/benchmark.h>

#include <cstdlib>
#include <iostream>
#include <map>

#include "services/lab/sim/core/simulated_robot.h"
#include "services/lab/sim/places/place.h"

// Pictures a second of the simulator's cameras on one core: a robot's whole step (ground, perfect
// view, blur, noise) in every built-in place, other cameras in two of them, and the perfect view
// alone. Compare CPU times.

namespace trailcast::sim {
namespace {

const Place& PlaceOf(const std::string& name) {
  static std::map<std::string, Place> places;
  if (const auto known = places.find(name); known != places.end()) return known->second;
  PlaceOptions options;
  options.world = name;
  auto made = OpenPlace(options);
  if (!made) {
    std::cerr << made.error().message << '\n';
    std::abort();
  }
  return places.emplace(name, std::move(*made)).first->second;
}

// Robots spread along the path, each facing along it.
std::vector<std::unique_ptr<SimulatedRobot>> RobotsAlong(const Place& place, const char* camera) {
  constexpr int kRobots = 8;
  const Polyline& path = place.path.points;
  std::vector<std::unique_ptr<SimulatedRobot>> robots;
  for (int i = 0; i < kRobots; ++i) {
    const double along_m = Length(path) * i / kRobots;
    const Eigen::Vector2d at = PointAlong(path, along_m);
    const Eigen::Vector2d ahead = PointAlong(path, along_m + 0.5) - at;
    SimulatedRobotOptions options;
    options.camera = *FindCamera(camera);
    options.start = {at.x(), at.y(), std::atan2(ahead.y(), ahead.x())};
    auto robot = SimulatedRobot::Create(place.world, options);
    if (!robot) {
      std::cerr << robot.error().message << '\n';
      std::abort();
    }
    robots.push_back(std::move(*robot));
  }
  return robots;
}

void WholeStep(benchmark::State& state, const std::string& place, const char* camera) {
  const auto robots = RobotsAlong(PlaceOf(place), camera);
  constexpr std::size_t kStepsInARow = 5;
  std::size_t step = 0;
  for ([[maybe_unused]] auto _ : state) {
    // To and fro, so that a long measurement stays where it began.
    const double turn_radps = step / (kStepsInARow * robots.size()) % 2 == 0 ? 0.2 : -0.2;
    SimulatedRobot& robot = *robots[step++ / kStepsInARow % robots.size()];
    benchmark::DoNotOptimize(robot.Step({0.1, turn_radps}).image.pixels.data());
  }
  state.counters["frames/s"] =
      benchmark::Counter(static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
}

void PerfectView(benchmark::State& state, const std::string& place) {
  const CameraModel camera = *FindCamera("webcam");
  CameraRenderer renderer(PlaceOf(place).world, camera);
  const motion::Pose2 start = StartPose(PlaceOf(place).path.points);
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() = Eigen::Vector3d(start.x_m, start.y_m, camera.height_m);
  const Eigen::AngleAxisd heading(start.heading_rad, Eigen::Vector3d::UnitZ());
  pose.linear() = heading.toRotationMatrix() * BodyFromCamera(0.0, 0.0);
  for ([[maybe_unused]] auto _ : state) benchmark::DoNotOptimize(renderer.Render(pose).gray.data());
}

void Register() {
  const auto add = [](const std::string& name, auto&&... arguments) {
    benchmark::RegisterBenchmark(name.c_str(), arguments...)->Unit(benchmark::kMillisecond);
  };
  for (const std::string& place : BuiltInPlaces()) {
    add("WholeStep/" + place + "/webcam", WholeStep, place, "webcam");
  }
  for (const char* camera : {"wide", "hd", "omni"}) {
    for (const char* place : {"indoor", "paved"}) {
      add(std::string("WholeStep/") + place + "/" + camera, WholeStep, place, camera);
    }
  }
  for (const char* place : {"indoor", "paved"}) {
    add(std::string("PerfectView/") + place + "/webcam", PerfectView, place);
  }
}

}  // namespace
}  // namespace trailcast::sim

int main(int argc, char** argv) {
  trailcast::sim::Register();
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
