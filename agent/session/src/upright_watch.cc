#include "agent/session/src/upright_watch.h"

#include <fmt/format.h>

#include <cmath>

namespace trailcast::agent {
namespace {

constexpr int kRecognised = 10;    // features that agree
constexpr int kNotRecognised = 7;  // as many agree in any picture
constexpr int kEachFrame = 10;     // is looked at, of the first ones
constexpr int kOneInSoMany = 5;    // after that
constexpr double kWatched_s = 20.0;

}  // namespace

bool UprightWatch::Look(const Seen& seen, const PlaceKeeper& place) {
  if (upright_ || misturned_ || watched_s_ > kWatched_s) return misturned_;
  watched_s_ += seen.looked_s;
  const bool due = frames_ < kEachFrame || frames_ % kOneInSoMany == 0;
  ++frames_;
  if (!due) return false;
  const int as_it_is = place.AgreedIn(*seen.frame);
  upright_ = as_it_is >= kRecognised;
  if (as_it_is > kNotRecognised) return false;
  double best_deg = 0.0;
  int best = kRecognised - 1;
  for (const double turn_deg : {180.0, 90.0, 270.0}) {
    vision::PictureIntake turned({.roll_deg = turn_deg});
    const int agreed = place.AgreedIn(turned.Take(*seen.frame));
    if (agreed <= best) continue;
    best = agreed;
    best_deg = turn_deg;
  }
  misturned_ = best_deg != 0.0 && best_deg == turn_deg_;  // twice the same is no chance
  turn_deg_ = best_deg;
  if (!misturned_) return false;
  reason_ = fmt::format(
      "the camera is mounted {} against the one that taught: {} features agree with the route once "
      "the picture is turned by {:g} degrees, {} as it is; begin again with --camera-roll {:g}",
      best_deg == 180.0 ? "upside down" : "on its side", best, best_deg, as_it_is,
      std::fmod(told_.roll_deg + best_deg + 360.0, 360.0));
  return true;
}

}  // namespace trailcast::agent
