#include <benchmark/benchmark.h>

#include <cstdlib>
#include <iostream>

#include "services/sim/indoor_world.h"
#include "services/sim/simulated_robot.h"

// Pictures a second of the simulator's cameras on one core, in the built-in indoor world: the
// perfect view alone, with a sun and its shadows, and the whole step with blur and noise. Compare
// CPU times.

namespace trailcast::sim {
namespace {

const Place& Indoor() {
  static const Place indoor = [] {
    auto made = MakeIndoorWorld();
    if (!made) {
      std::cerr << made.error().message << '\n';
      std::abort();
    }
    return *made;
  }();
  return indoor;
}

Eigen::Isometry3d OnPath(double along_m, const CameraModel& camera) {
  const Polyline& path = Indoor().path.points;
  const Eigen::Vector2d at = PointAlong(path, along_m);
  const Eigen::Vector2d ahead = PointAlong(path, along_m + 0.5) - at;
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() = Eigen::Vector3d(at.x(), at.y(), camera.height_m);
  const double heading_rad = std::atan2(ahead.y(), ahead.x());
  pose.linear() = Eigen::AngleAxisd(heading_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix() *
                  BodyFromCamera(0.0, 0.0);
  return pose;
}

void RenderAlongPath(benchmark::State& state, const char* name, const Lighting& lighting) {
  const auto camera = FindCamera(name);
  CameraRenderer renderer(Indoor().world, *camera, lighting);
  double along_m = 0.0;
  for ([[maybe_unused]] auto _ : state) {
    along_m = along_m > 14.0 ? 0.0 : along_m + 0.37;
    benchmark::DoNotOptimize(renderer.Render(OnPath(along_m, *camera)).gray.data());
  }
  state.counters["frames/s"] =
      benchmark::Counter(static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
}

void PerfectViewOf(benchmark::State& state, const char* name) {
  RenderAlongPath(state, name, Indoor().world->lighting());
}
BENCHMARK_CAPTURE(PerfectViewOf, webcam, "webcam")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(PerfectViewOf, wide, "wide")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(PerfectViewOf, hd, "hd")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(PerfectViewOf, omni, "omni")->Unit(benchmark::kMillisecond);

void PerfectViewInSunshine(benchmark::State& state) {
  RenderAlongPath(state, "webcam", Lighting());
}
BENCHMARK(PerfectViewInSunshine)->Unit(benchmark::kMillisecond);

void WholeStepInATurn(benchmark::State& state) {
  SimulatedRobotOptions options;
  options.camera = *FindCamera("webcam");
  options.start = StartPose(Indoor().path.points);
  auto robot = SimulatedRobot::Create(Indoor().world, options);
  for ([[maybe_unused]] auto _ : state)
    benchmark::DoNotOptimize((*robot)->Step({0.1, 0.4}).image.pixels.data());
  state.counters["frames/s"] =
      benchmark::Counter(static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
}
BENCHMARK(WholeStepInATurn)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace trailcast::sim

BENCHMARK_MAIN();
