#include "agent/session/src/mount_watch.h"

#include <fmt/format.h>

#include <cmath>

namespace trailcast::agent {

double RollAfter(double roll_deg, double turn_deg) {
  return std::fmod(roll_deg + turn_deg + 360.0, 360.0);
}

const char* HangsText(double roll_deg) { return roll_deg == 180.0 ? "upside down" : "on its side"; }

void MountWatch::Add(std::span<const teach::MovedFeature> moved,
                     const std::optional<motion::OdometryIncrement>& told,
                     const std::optional<motion::OdometryIncrement>& measured, double dt_s,
                     int longer_side_px) {
  if (told) {
    was_told_ |= told->heading_change_rad != 0.0;
    by_told_.Add(moved, told->heading_change_rad, dt_s, longer_side_px);
  }
  if (measured) by_measured_.Add(moved, measured->heading_change_rad, dt_s, longer_side_px);
}

std::string MountWatch::Text() const {
  const double roll_deg = this->roll_deg().value_or(0.0);
  const auto other = was_told_ ? by_measured_.roll_deg() : std::nullopt;
  const std::string seen = fmt::format(
      "the camera looks {}: as the robot {}, the picture moves {}", HangsText(roll_deg),
      was_told_ ? "is told to turn" : "turns by its odometry",
      roll_deg == 180.0 ? "the other way than it would" : "up and down instead of to the side");
  if (roll_deg != 180.0) return seen;
  if (other == roll_deg) return seen + " (odometry agrees, so the base is not to blame)";
  if (!was_told_) {
    return seen +
           " (or odometry counts turns the wrong way, which looks the same: counter-clockwise is "
           "positive, REP 103)";
  }
  return seen + (other ? " (but odometry agrees with the picture: the base turns right when it is "
                         "told left, so turn the sign of angular.z; or odometry counts turns the "
                         "wrong way, and the pictures were turned for that)"
                       : " (or the base turns right when it is told left, which looks the same)");
}

}  // namespace trailcast::agent
