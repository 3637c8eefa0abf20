#pragma once

#include <optional>
#include <string>
#include <vector>

#include "services/base/result.h"
#include "services/lab/sim/places/place_change.h"

namespace trailcast::trial {

// Figures from table I of Chen & Birchfield 2009, in metres, over ten trials each.
struct PaperFigures {
  double accuracy_m = 0.0;
  double repeatability_m = 0.0;
  double largest_final_error_m = 0.0;
};

// The cameras of scout and follower, by name; an empty one is the command line's.
struct CameraPair {
  std::string scout;
  std::string follower;
};

// One of the experiments by which following is measured. Each trial is run once for every pair of
// cameras, for every push and for every flaw.
struct Scenario {
  std::string name;
  std::string summary;
  std::string place;  // a built-in place of services/lab/sim
  std::vector<CameraPair> cameras = {{}};
  // The follower is pushed this far to the side, half way; its odometry does not notice.
  std::vector<double> pushes_m = {0.0};
  // How the place has changed when it is followed. With several visits, the change grows until the
  // last of them.
  std::optional<sim::PlaceChange> change;
  bool through_server = false;  // followers get their route from a route server
  // The follower's flaws, as real robots have them, each in trials of its own; an empty one is
  // none.
  std::vector<std::string> flaws = {""};
  std::optional<double> gain;  // the follower's exposure relative to the scout's; otherwise drawn
  // Others move about while the robots drive: the place's traffic, and a person who stands in the
  // follower's way for ten seconds.
  bool traffic = false;
  bool somebody_in_the_way = false;
  double somebody_ahead_m = 0.8;  // from the follower's middle
  // The follower has a scanner, and stops before obstacles. A cart stands half on its path, and the
  // follower may pass it so far beside the path.
  bool scanner = false;
  bool parked_cart = false;
  double pass_m = 0.0;
  std::optional<PaperFigures> paper;     // for the method of 2009
  std::optional<PaperFigures> icra2006;  // for the method's first version
};

[[nodiscard]] const std::vector<Scenario>& Scenarios();
// kNotFound lists the existing names.
[[nodiscard]] Result<Scenario> FindScenario(const std::string& name);
[[nodiscard]] std::vector<std::string> ScenarioNames();

}  // namespace trailcast::trial
