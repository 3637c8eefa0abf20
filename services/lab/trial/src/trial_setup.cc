#include "services/lab/trial/trial_setup.h"

#include <filesystem>
#include <limits>
#include <utility>

#include "agent/session/look_around.h"
#include "services/base/angles.h"
#include "services/lab/sim/places/place_change.h"
#include "services/lab/sim/places/traffic.h"
#include "services/lab/simulated/camera_file.h"
#include "services/lab/trial/flaws.h"
#include "services/lab/trial/scenario.h"
#include "services/lab/trial/src/scanned_way.h"

namespace trailcast::trial {
namespace {

constexpr double kLapGap_m = 1.0;
// The longest segment of the printed methods, which follows from the paper's figures
// (docs/explanation/following.md).
constexpr double kPrintedSegment_m = 0.4;

Result<std::vector<agent::ReplayMethod>> FindMethods(const std::vector<std::string>& names) {
  std::vector<agent::ReplayMethod> methods;
  for (const std::string& name : names) {
    const auto method = agent::FindReplayMethod(name);
    if (!method) return tl::unexpected(method.error());
    methods.push_back(*method);
  }
  return methods;
}

// Combines every method with every pair of cameras, every push and every flaw.
Result<std::vector<TrialCase>> MakeCases(const Scenario& scenario, const TrialOptions& options) {
  const auto methods = FindMethods(options.methods);
  if (!methods) return tl::unexpected(methods.error());
  const std::vector<std::string>& flaws = options.flaws.empty() ? scenario.flaws : options.flaws;
  for (const std::string& flaw : flaws) {
    if (auto known = CheckFlaw(flaw); !known) return tl::unexpected(known.error());
  }
  std::vector<TrialCase> cases;
  for (const agent::ReplayMethod method : *methods) {
    for (const CameraPair& pair : scenario.cameras) {
      auto scout = agent::CameraFromWord(pair.scout.empty() ? options.scout_camera : pair.scout);
      if (!scout) return tl::unexpected(scout.error());
      auto follower =
          agent::CameraFromWord(pair.follower.empty() ? options.follower_camera : pair.follower);
      if (!follower) return tl::unexpected(follower.error());
      for (const double push_m : scenario.pushes_m) {
        for (const std::string& flaw : flaws) {
          TrialCase each{method, *scout, *follower, push_m, scenario.through_server, flaw};
          if (options.matrix) {
            for (const MatrixCell& cell : MatrixCells()) {
              each.cell = cell;
              cases.push_back(each);
            }
            continue;
          }
          for (each.start = std::min(1, options.starts); each.start <= options.starts;
               ++each.start) {
            cases.push_back(each);
          }
        }
      }
    }
  }
  return cases;
}

Result<sim::Actors> DrawActors(const Scenario& scenario, const sim::Place& place, sim::Role role,
                               std::uint64_t seed) {
  sim::Actors actors;
  if (scenario.traffic) {
    auto traffic = sim::TrafficFor(place, role, seed);
    if (!traffic) return traffic;
    actors = std::move(*traffic);
  }
  if (scenario.somebody_in_the_way && role == sim::Role::kFollower) {
    auto somebody = sim::SomebodyInTheWay(place, seed, scenario.somebody_ahead_m);
    if (!somebody) return tl::unexpected(somebody.error());
    actors.push_back(std::move(*somebody));
  }
  if (scenario.parked_cart && role == sim::Role::kFollower) {
    auto cart = sim::CartOnThePath(place, seed);
    if (!cart) return tl::unexpected(cart.error());
    actors.push_back(std::move(*cart));
  }
  return actors;
}

// One robot has one camera, and nobody was about where the paper measured.
Result<void> TakeSameRobot(Scenario& scenario, TrialSetup& setup) {
  for (const TrialCase& each : setup.cases) {
    if (each.scout_camera.name == each.follower_camera.name) continue;
    return Fail(ErrorCode::kInvalidArgument,
                "the same robot cannot teach with camera '{}' and follow with camera '{}'",
                each.scout_camera.name, each.follower_camera.name);
  }
  scenario.traffic = false;
  setup.same_robot = true;
  setup.follower.gain_low = setup.follower.gain_high = 1.0;
  return {};
}

// Opens the user's own world and path, or the scenario's place.
Result<void> OpenScene(const Scenario& scenario, const TrialOptions& options, TrialSetup& setup) {
  sim::PlaceOptions where = options.place;
  if (where.world.empty()) where.world = scenario.place;
  auto place = sim::OpenPlace(where);
  if (!place) return tl::unexpected(place.error());
  if (options.speed_mps > 0.0) place->speed_mps = options.speed_mps;
  setup.world = place->world;
  setup.path = place->path;
  const double gap_m = (setup.path.points.back() - setup.path.points.front()).norm();
  if (options.laps > 1 && gap_m > kLapGap_m) {
    return Fail(
        ErrorCode::kInvalidArgument,
        "{} laps were asked for, but the path ends {:.1f} m from where it begins; laps need "
        "one that comes back to within {:g} m",
        options.laps, gap_m, kLapGap_m);
  }
  setup.laps = options.laps;
  setup.speed_mps = place->speed_mps;
  setup.follower.slip = place->slip;
  setup.actors = [scenario, place = *place](sim::Role role, std::uint64_t seed) {
    return DrawActors(scenario, place, role, seed);
  };
  if (scenario.change) {
    setup.world_after = [name = scenario.place, full = *scenario.change](
                            double share) -> Result<std::shared_ptr<const sim::World>> {
      auto changed = sim::OpenChangedPlace(
          name, {share * full.night, share * full.textures, share * full.moved, full.seed});
      if (!changed) return tl::unexpected(changed.error());
      return std::move(changed->world);
    };
  }
  setup.sun_moves =
      options.place.world.empty() && !options.same_robot && setup.world->lighting().sun > 0.0F;
  return {};
}

// Where its robots begin, and where they go, is the matrix's matter.
Result<void> CheckMatrix(const Scenario& scenario, const TrialOptions& options) {
  if (!options.matrix) return {};
  if (options.backwards || options.starts > 0 || options.visits > 0 || options.laps > 1 ||
      options.same_robot || scenario.pushes_m.size() > 1) {
    return Fail(ErrorCode::kInvalidArgument,
                "the matrix sets where robots begin and go: leave out backwards, starts, visits, "
                "laps, the same robot and scenarios that push");
  }
  if (options.odometry != "both" && options.odometry != "scout") {
    return Fail(ErrorCode::kInvalidArgument,
                "half of the matrix is driven backwards, which takes a scout with odometry");
  }
  return {};
}

// The user's own world is a scenario without a name of its own.
Result<Scenario> ScenarioOf(const TrialOptions& options) {
  if (options.place.world.empty()) return FindScenario(options.scenario);
  Scenario own;
  own.name = std::filesystem::path(options.place.world).stem().string();
  return own;
}

}  // namespace

agent::TeachOptions TeachingFor(agent::ReplayMethod method) {
  agent::TeachOptions options;
  if (agent::AsPrinted(method)) {
    options.recorder.longest_m = kPrintedSegment_m;
    options.recorder.fewest_kept = std::numeric_limits<std::size_t>::max();
    options.middle_features = 0;
  }
  return options;
}

Result<TrialSetup> PrepareTrials(const TrialOptions& options) {
  TrialSetup setup;
  auto scenario = ScenarioOf(options);
  if (!scenario) return tl::unexpected(scenario.error());
  if (options.refresh && options.visits == 0) {
    return Fail(ErrorCode::kInvalidArgument,
                "a route is refreshed for the next visit: how many visits are there to be?");
  }
  const auto spoiled = FindSpoiled(options.spoiled);
  if (!spoiled) return tl::unexpected(spoiled.error());
  if (*spoiled != Spoiled::kNothing && options.visits == 0) {
    return Fail(ErrorCode::kInvalidArgument,
                "what is spoiled is seen by who comes after: how many visits are there to be?");
  }
  setup.spoiled = *spoiled;
  auto noise = ParseOdometryNoise(options.odometry_noise);
  if (!noise) return tl::unexpected(noise.error());
  setup.odometry_noise = std::move(*noise);
  setup.scout_has_odometry = options.odometry == "both" || options.odometry == "scout";
  setup.follower_has_odometry = options.odometry == "both" || options.odometry == "follower";
  setup.scenario = scenario->name;
  auto cases = MakeCases(*scenario, options);
  if (!cases) return tl::unexpected(cases.error());
  setup.cases = std::move(*cases);
  if (options.same_robot) {
    if (auto taken = TakeSameRobot(*scenario, setup); !taken) return tl::unexpected(taken.error());
  }
  if (options.backwards && (options.starts > 0 || options.visits > 0 || options.laps > 1)) {
    return Fail(ErrorCode::kInvalidArgument,
                "backwards a route is followed once, from its end: leave out laps, starts and "
                "visits");
  }
  if (auto sound = CheckMatrix(*scenario, options); !sound) return tl::unexpected(sound.error());
  setup.backwards = options.backwards;
  setup.follower_options.anywhere = options.starts > 0 && !options.told_m;
  setup.follower_options.take_experience = options.refresh;
  setup.scout_roll_deg = options.scout_roll_deg;
  setup.follower_options.intake.roll_deg = options.follower_roll_deg;
  setup.follower_options.camera_ahead_m = options.follower_ahead_m;
  setup.scanner = scenario->scanner;
  setup.follower_options.passing.most_m = options.pass_obstacles_m.value_or(scenario->pass_m);
  setup.follower_options.look_around_rad = Radians(agent::kUsualLookAround_deg);
  setup.follower_options.passing.robot = agent::OutlineOf(SimulatedBody());
  if (scenario->gain) setup.follower.gain_low = setup.follower.gain_high = *scenario->gain;
  if (auto opened = OpenScene(*scenario, options, setup); !opened) {
    return tl::unexpected(opened.error());
  }
  return setup;
}

std::vector<std::string> CameraNames() {
  std::vector<std::string> names;
  for (const sim::CameraModel& each : sim::BuiltInCameras()) names.push_back(each.name);
  return names;
}

}  // namespace trailcast::trial
