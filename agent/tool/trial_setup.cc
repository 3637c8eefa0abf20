#include "agent/tool/trial_setup.h"

#include <array>
#include <utility>

#include "agent/camera_file.h"
#include "services/sim/indoor_world.h"
#include "services/sim/load_world.h"
#include "services/sim/path_follow_driver.h"

namespace trailcast::tool {
namespace {

constexpr const char* kIndoor = "indoor";

struct NamedMethod {
  const char* name;
  agent::ReplayMethod method;
};
constexpr std::array<NamedMethod, 2> kMethods{
    {{"default", agent::ReplayMethod::kDefault}, {"paper", agent::ReplayMethod::kPaper}}};

Result<agent::ReplayMethod> FindMethod(const std::string& name) {
  for (const NamedMethod& each : kMethods) {
    if (name == each.name) return each.method;
  }
  return Fail(ErrorCode::kNotFound, "there is no method '{}'; there are: {}", name,
              fmt::join(MethodNames(), ", "));
}

// A world and a path of the user's own.
Result<void> LoadOwnWorld(const TrialOptions& options, TrialSetup& setup) {
  if (options.path_file.empty()) {
    return Fail(ErrorCode::kInvalidArgument,
                "a world needs a path through it: --path FILE with the header x_m,y_m");
  }
  sim::WorldFileOptions file;
  file.file = options.world_file;
  file.scale = options.scale;
  const auto up = sim::ParseUpAxis(options.up);
  if (!up) return tl::unexpected(up.error());
  file.up = *up;
  const auto ground = sim::ParseGroundMode(options.ground);
  if (!ground) return tl::unexpected(ground.error());
  file.ground = *ground;
  auto world = sim::LoadWorld(file);
  if (!world) return tl::unexpected(world.error());
  auto path = sim::ReadPath(options.path_file);
  if (!path) return tl::unexpected(path.error());
  setup.scenario = options.world_file.stem().string();
  setup.world = std::move(*world);
  setup.path = std::move(*path);
  setup.speed_mps = sim::DriverOptions{}.speed_mps;
  return {};
}

Result<void> LoadScenario(const TrialOptions& options, TrialSetup& setup) {
  if (options.scenario != kIndoor) {
    return Fail(ErrorCode::kNotFound, "there is no scenario '{}'; there are: {}", options.scenario,
                fmt::join(ScenarioNames(), ", "));
  }
  auto built = sim::MakeIndoorWorld();
  if (!built) return tl::unexpected(built.error());
  setup.scenario = options.scenario;
  setup.world = std::move(built->world);
  setup.path = std::move(built->path);
  setup.speed_mps = sim::DriverOptions{}.speed_mps;
  return {};
}

}  // namespace

Result<TrialSetup> PrepareTrials(const TrialOptions& options) {
  TrialSetup setup;
  const auto method = FindMethod(options.method);
  if (!method) return tl::unexpected(method.error());
  setup.method = options.method;
  setup.session.method = *method;
  auto scout_camera = agent::CameraFromWord(options.scout_camera);
  if (!scout_camera) return tl::unexpected(scout_camera.error());
  setup.scout_camera = std::move(*scout_camera);
  auto follower_camera = agent::CameraFromWord(options.follower_camera);
  if (!follower_camera) return tl::unexpected(follower_camera.error());
  setup.follower_camera = std::move(*follower_camera);
  const auto loaded =
      options.world_file.empty() ? LoadScenario(options, setup) : LoadOwnWorld(options, setup);
  if (!loaded) return tl::unexpected(loaded.error());
  if (options.speed_mps > 0.0) setup.speed_mps = options.speed_mps;
  return setup;
}

std::vector<std::string> ScenarioNames() { return {kIndoor}; }

std::vector<std::string> MethodNames() {
  std::vector<std::string> names;
  names.reserve(kMethods.size());
  for (const NamedMethod& each : kMethods) names.emplace_back(each.name);
  return names;
}

std::vector<std::string> CameraNames() {
  std::vector<std::string> names;
  for (const sim::CameraModel& each : sim::BuiltInCameras()) names.push_back(each.name);
  return names;
}

}  // namespace trailcast::tool
