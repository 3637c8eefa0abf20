#pragma once

#include <optional>
#include <string>
#include <vector>

#include "services/base/result.h"
#include "services/lab/sim/places/place_change.h"

namespace trailcast::trial {

// Table I of Chen & Birchfield 2009, metres, ten trials each.
struct PaperFigures {
  double accuracy_m = 0.0;
  double repeatability_m = 0.0;
  double largest_final_error_m = 0.0;
};

// Who teaches and who follows. A camera's name, or empty: the one that the command line says.
struct CameraPair {
  std::string scout;
  std::string follower;
};

// One of the experiments that following is measured by. Each trial is run once for every pair of
// cameras, for every push and for every flaw.
struct Scenario {
  std::string name;
  std::string summary;
  std::string place;  // a built-in place of services/lab/sim
  std::vector<CameraPair> cameras = {{}};
  // The follower is shoved this far to the side, half way; its odometry does not notice.
  std::vector<double> pushes_m = {0.0};
  // What has become of the place when it is followed; of several visits, by the last of them: until
  // then it comes bit by bit.
  std::optional<sim::PlaceChange> change;
  bool through_server = false;  // followers replay what a route server gives them
  // What the follower has of real robots' flaws, each in trials of its own; empty: none.
  std::vector<std::string> flaws = {""};
  std::optional<double> gain;  // exposure of the follower against the scout's; drawn
  // Others move about while the robots drive: the place's traffic, and somebody who stands in the
  // follower's way for ten seconds.
  bool traffic = false;
  bool somebody_in_the_way = false;
  double somebody_ahead_m = 0.8;  // of the follower's middle, once there
  // The follower has a scanner, and stands before what that sees in its way; a cart was left half
  // on its path; and it may go round that so far beside the path.
  bool scanner = false;
  bool parked_cart = false;
  double pass_m = 0.0;
  std::optional<PaperFigures> paper;     // of the 2009 method
  std::optional<PaperFigures> icra2006;  // of the first version
};

[[nodiscard]] const std::vector<Scenario>& Scenarios();
// kNotFound lists the names there are.
[[nodiscard]] Result<Scenario> FindScenario(const std::string& name);
[[nodiscard]] std::vector<std::string> ScenarioNames();

}  // namespace trailcast::trial
