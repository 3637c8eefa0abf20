#include "agent/tool/trial_setup.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <utility>

#include "agent/camera_file.h"

namespace trailcast::tool {
namespace {

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

// A world and a path of the user's own, or the scenario's.
Result<void> OpenScene(const TrialOptions& options, TrialSetup& setup) {
  sim::PlaceOptions where = options.place;
  setup.scenario = std::filesystem::path(where.world).stem().string();
  if (where.world.empty()) {
    const auto names = ScenarioNames();
    if (std::find(names.begin(), names.end(), options.scenario) == names.end()) {
      return Fail(ErrorCode::kNotFound, "there is no scenario '{}'; there are: {}",
                  options.scenario, fmt::join(names, ", "));
    }
    setup.scenario = where.world = options.scenario;
  }
  auto place = sim::OpenPlace(where);
  if (!place) return tl::unexpected(place.error());
  setup.world = std::move(place->world);
  setup.path = std::move(place->path);
  setup.speed_mps = place->speed_mps;
  setup.follower.slip = place->slip;
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
  if (auto opened = OpenScene(options, setup); !opened) return tl::unexpected(opened.error());
  if (options.speed_mps > 0.0) setup.speed_mps = options.speed_mps;
  return setup;
}

std::vector<std::string> ScenarioNames() { return sim::BuiltInPlaces(); }

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
