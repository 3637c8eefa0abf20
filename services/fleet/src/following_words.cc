#include "services/fleet/following_words.h"

#include <fmt/format.h>

#include <algorithm>

namespace trailcast::fleet {
namespace {

using exchange::CarriedBy;
using exchange::OdometryTrust;

// Odometry with less than this contradicts what is seen.
constexpr int kBelieved_percent = 20;
// With this or more, nothing else tells better how the robot moves.
constexpr int kTrusted_percent = 50;
// Odometry of its kind is usually off by this much.
constexpr double kUsualScale = 1.05;

// Odometry is not believed if it disagrees with the pictures.
std::string NotBelieved(CarriedBy carried_by) {
  switch (carried_by) {
    case CarriedBy::kFeatures:
    case CarriedBy::kViews:
      return "not believed; the pictures carry the robot";
    case CarriedBy::kMotion:
      return "not believed, and the pictures do not show the route";
    case CarriedBy::kNothing:
      break;
  }
  return "not believed";
}

std::string Scaled(double scale) {
  const double factor = scale > 0.0 ? std::max(scale, 1.0 / scale) : 1.0;
  if (factor < kUsualScale) return "trusted";
  return fmt::format("counts {:.2f} times too {} for this route, corrected", factor,
                     scale < 1.0 ? "much" : "little");
}

std::string OdometryWords(const OdometryTrust& odometry, CarriedBy carried_by) {
  if (odometry.percent < kBelieved_percent) return NotBelieved(carried_by);
  std::string words =
      odometry.percent < kTrusted_percent ? std::string("in doubt") : Scaled(odometry.scale);
  if (carried_by == CarriedBy::kMotion) words += "; it alone carries the robot";
  return words;
}

}  // namespace

std::string FollowingText(const exchange::AgentStatus& status) {
  if (!status.following) return {};
  const auto& [carried_by, odometry] = *status.following;
  if (!odometry) return "Follows by its camera alone";
  return "Odometry: " + OdometryWords(*odometry, carried_by);
}

}  // namespace trailcast::fleet
