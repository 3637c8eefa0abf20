#include "agent/session/src/upright_watch.h"

#include <fmt/format.h>

#include <utility>

#include "services/vision/picture_intake.h"

namespace trailcast::agent {
namespace {

constexpr int kRecognised = 10;    // features that agree
constexpr int kNotRecognised = 7;  // as many agree in any picture
constexpr int kEachFrame = 10;     // of the first ones, each is examined
constexpr int kOneInSoMany = 5;    // after that
constexpr double kWatched_s = 20.0;

}  // namespace

std::optional<double> UprightWatch::Look(const FrameInput& seen, const Localiser& place) {
  if (upright_ || watched_s_ > kWatched_s) return std::nullopt;
  watched_s_ += seen.looked_s;
  const bool due = frames_ < kEachFrame || frames_ % kOneInSoMany == 0;
  ++frames_;
  if (!due) return std::nullopt;
  as_it_is_ = place.AgreedIn(*seen.frame);
  upright_ = as_it_is_ >= kRecognised;
  if (as_it_is_ > kNotRecognised) return std::nullopt;
  const double before_deg = std::exchange(turn_deg_, 0.0);
  agreed_ = kRecognised - 1;
  for (const double turn_deg : {180.0, 90.0, 270.0}) {
    vision::PictureIntake turned({.roll_deg = turn_deg});
    const int agreed = place.AgreedIn(turned.Take(*seen.frame));
    if (agreed <= agreed_) continue;
    agreed_ = agreed;
    turn_deg_ = turn_deg;
  }
  upright_ = turn_deg_ != 0.0 && turn_deg_ == before_deg;  // twice the same is no coincidence
  return upright_ ? std::optional(turn_deg_) : std::nullopt;
}

std::string UprightWatch::Text() const {
  return fmt::format(
      "the camera hangs {} against the one that taught: {} features agree with the route once the "
      "picture is turned by {:g} degrees, {} as it is",
      HangsText(turn_deg_), agreed_, turn_deg_, as_it_is_);
}

}  // namespace trailcast::agent
