#include "services/lab/trial/scenario.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "services/lab/sim/core/camera.h"
#include "services/lab/trial/flaws.h"

namespace trailcast::trial {
namespace {

std::vector<CameraPair> EveryPair() {
  std::vector<CameraPair> pairs;
  for (const sim::CameraModel& scout : sim::BuiltInCameras()) {
    for (const sim::CameraModel& follower : sim::BuiltInCameras()) {
      pairs.push_back({scout.name, follower.name});
    }
  }
  return pairs;
}

std::vector<Scenario> MakeScenarios() {
  std::vector<Scenario> all;
  const auto add = [&](const char* name, const char* summary, const char* place) -> Scenario& {
    Scenario& scenario = all.emplace_back();
    scenario.name = name;
    scenario.summary = summary;
    scenario.place = place;
    return scenario;
  };
  Scenario& indoor = add("indoor", "15 m through a furnished laboratory (Table I)", "indoor");
  indoor.paper = {0.14, 0.08, 0.23};
  indoor.icra2006 = {0.30, 0.18, 0.45};
  Scenario& paved = add("paved", "60 m over a parking lot (Table I)", "paved");
  paved.paper = {0.60, 0.55, 1.20};
  paved.icra2006 = {0.77, 0.74, 1.20};
  paved.traffic = true;
  Scenario& rough = add("rough", "40 m over rough ground (Table I)", "rough");
  rough.paper = {1.47, 0.66, 1.76};
  rough.icra2006 = {3.87, 1.85, 5.68};
  add("desks", "10 m between chairs and desks, tight", "desks");
  add("loop", "380 m round a parking lot", "loop");
  add("ramp", "40 m over a slanted ramp", "ramp");
  add("traffic", "80 m of narrow road, a pedestrian passes, then a van", "road").traffic = true;
  add("occlusion", "a person stands in front of the camera for ten seconds", "indoor")
      .somebody_in_the_way = true;
  Scenario& blocked =
      add("blocked", "with a scanner: a person stands in the way for ten seconds", "indoor");
  blocked.somebody_in_the_way = true;
  blocked.somebody_ahead_m = 1.6;  // so that the scanner stops the robot
  blocked.scanner = true;
  Scenario& parked = add("parked", "with a scanner: a cart was left half on the path", "indoor");
  parked.parked_cart = true;
  parked.scanner = true;
  parked.pass_m = 0.8;
  add("wide", "indoor's world through a 110 degree lens", "indoor").cameras = {{"wide", "wide"}};
  add("omni", "indoor's world through a 360 degree mirror", "indoor").cameras = {{"omni", "omni"}};
  Scenario& twocams = add("twocams", "a parking lot with one camera, then with another", "paved");
  twocams.cameras = {{"webcam", "webcam"}, {"hd", "hd"}};
  twocams.traffic = true;
  Scenario& swarm = add("swarm", "a scout teaches, others follow from the route server", "indoor");
  swarm.cameras = {{"webcam", "firewire"}, {"webcam", "wide"}, {"webcam", "hd"}};
  swarm.through_server = true;
  add("turns", "25 m round sharp corners", "turns");
  Scenario& pushed = add("pushed", "shoved 1, 2 and 3 m off the path", "paved");
  pushed.pushes_m = {1.0, -2.0, 3.0};
  pushed.traffic = true;
  add("cameras", "every scout camera with every follower camera", "indoor").cameras = EveryPair();
  add("corridor", "30 m of corridor, 4 m of it without texture", "corridor");
  add("field", "30 m in the open, all features far away", "field");
  add("rows", "50 m between forty rows of plants that look alike", "rows");
  add("dead-end", "18 m into a dead end and back, turned on the spot", "dead-end");
  add("shunt", "22 m, backwards out of a parking place and on", "parking-place");
  Scenario& robots = add("robots", "indoor, and all that real robots do wrong", "indoor");
  for (const std::string& flaw : FlawNames()) robots.flaws.push_back(flaw);
  Scenario& robots_paved = add("robots-paved", "the same on a parking lot", "paved");
  robots_paved.flaws = robots.flaws;
  robots_paved.traffic = true;
  add("night", "indoor, followed by lamps that stand elsewhere", "indoor").change = {.night = 1.0};
  add("seasons", "indoor, a third of its textures changed", "indoor").change = {.textures =
                                                                                    1.0 / 3.0};
  add("moved", "indoor, a third of its furniture moved", "indoor").change = {.moved = 1.0 / 3.0};
  add("dusk", "indoor, taught at noon and followed at dusk", "indoor").gain = 0.4;
  return all;
}

}  // namespace

const std::vector<Scenario>& Scenarios() {
  static const std::vector<Scenario> all = MakeScenarios();
  return all;
}

Result<Scenario> FindScenario(const std::string& name) {
  const auto& all = Scenarios();
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const Scenario& each) { return each.name == name; });
  if (found != all.end()) return *found;
  return Fail(ErrorCode::kNotFound, "there is no scenario '{}'; there are: {}", name,
              fmt::join(ScenarioNames(), ", "));
}

std::vector<std::string> ScenarioNames() {
  std::vector<std::string> names;
  names.reserve(Scenarios().size());
  for (const Scenario& each : Scenarios()) names.push_back(each.name);
  return names;
}

}  // namespace trailcast::trial
