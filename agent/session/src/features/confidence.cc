#include "agent/session/confidence.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace trailcast::agent {

const char* ToString(Trust trust) {
  switch (trust) {
    case Trust::kSure:
      return "sure";
    case Trust::kUnsure:
      return "unsure";
    case Trust::kDistant:
      return "distant";
    case Trust::kBlind:
      return "blind";
    case Trust::kCovered:
      return "covered";
    case Trust::kSeeking:
      return "seeking";
    case Trust::kLooking:
      return "looking";
    case Trust::kLost:
      break;
  }
  return "lost";
}

int Confidence::Wanted(const Sighting& seen) const {
  const double wanted = std::clamp(options_.sure_share * seen.in_picture.value_or(seen.taught),
                                   options_.sure_least, options_.sure_most);
  return std::min(static_cast<int>(std::ceil(wanted)), seen.taught);
}

void Confidence::NoteView(const Sighting& seen) {
  if (seen.agreeing >= options_.good_view * Wanted(seen)) {
    since_good_s_ = 0.0;
    good_features_ = seen.agreeing;
    vanished_ = 0;
  } else if (since_good_s_) {
    *since_good_s_ += seen.dt_s;
    vanished_ += seen.vanished;
  }
}

void Confidence::SeekAnew(std::string not_found) {
  options_.not_found = std::move(not_found);
  sure_once_ = recognised_only_ = covered_ = false;
  unsure_m_ = unsure_s_ = 0.0;
  since_covered_s_.reset();
  since_good_s_.reset();
}

void Confidence::NoteCarry() {
  carries_ = SettlesAfterCarry() ? carries_ + 1 : 1;
  carried_at_m_ = driven_m_;
}

// Judges whether a robot that sees what it should knows where it is.
Verdict Confidence::JudgePlace(const Sighting& seen) const {
  if (!seen.left_sigma_m || *seen.left_sigma_m < options_.distant_sigma_m ||
      driven_m_ < options_.settle_m) {
    return {Trust::kSure, ""};
  }
  if (SettlesAfterCarry()) {
    return {Trust::kDistant,
            fmt::format("carried off the path: where to is known to {:.2f} m so far",
                        *seen.left_sigma_m)};
  }
  return {*seen.left_sigma_m < options_.lost_sigma_m ? Trust::kDistant : Trust::kLost,
          fmt::format("only distant features are in view: the place beside the path is known to "
                      "{:.2f} m at best",
                      *seen.left_sigma_m)};
}

// Judges whether a view that is gone was covered.
bool Confidence::CoveredNow(const Sighting& seen) const {
  if (!options_.stand_when_covered ||
      seen.in_picture.value_or(seen.taught) < options_.covered_least_expected) {
    return false;
  }
  if (since_covered_s_ && *since_covered_s_ <= options_.still_about_s + kTimeSlack_s) return true;
  return since_good_s_ && *since_good_s_ <= options_.covered_within_s + kTimeSlack_s &&
         VanishedInPlace();
}

Trust Confidence::Decide(const Sighting& seen, bool by_distance) const {
  if (covered_) {
    return unsure_s_ > options_.covered_limit_s + kTimeSlack_s ? Trust::kLost : Trust::kCovered;
  }
  if (by_distance ? unsure_m_ > options_.blind_limit_m
                  : unsure_s_ > options_.blind_limit_s + kTimeSlack_s) {
    return Trust::kLost;
  }
  if (!sure_once_) return Trust::kSeeking;
  const bool a_moment_ago = by_distance ? unsure_m_ <= options_.unsure_limit_m
                                        : unsure_s_ <= options_.unsure_limit_s + kTimeSlack_s;
  return seen.agreeing >= options_.min_features && a_moment_ago ? Trust::kUnsure : Trust::kBlind;
}

std::string Confidence::Explain(const Sighting& seen, bool by_distance) const {
  const std::string what = covered_ ? "something covers the view, or the camera was knocked aside: "
                           : sure_once_ ? ""
                                        : options_.not_found + ": ";
  const std::string since = by_distance && !covered_ ? fmt::format("{:.1f} m", unsure_m_)
                                                     : fmt::format("{:.1f} s", unsure_s_);
  return fmt::format("{}{} of segment {}'s {} features in view for {}; {} are needed to be sure",
                     what, seen.agreeing, seen.segment, seen.taught, since, Wanted(seen));
}

Verdict Confidence::Judge(const Sighting& seen,
                          const std::optional<motion::OdometryIncrement>& moved) {
  driven_m_ += moved ? std::abs(moved->distance_m) : 0.0;
  if (seen.carried_off) NoteCarry();
  if (carries_ > options_.carried_limit) {
    return {Trust::kLost, fmt::format("carried off {} times by what it sees: the features in view "
                                      "contradict each other",
                                      carries_)};
  }
  if (seen.taught < options_.min_features && sure_once_ && moved) {  // nothing was to be seen here
    return {Trust::kBlind, "this section was taught without features: on by odometry"};
  }
  NoteView(seen);
  if (since_covered_s_) *since_covered_s_ += seen.dt_s;
  const bool agrees = seen.agreeing >= Wanted(seen) && seen.taught >= options_.min_features;
  recognised_only_ = false;
  if (agrees && !seen.elsewhere) {
    sure_once_ = true;
    covered_ = false;
    unsure_m_ = 0.0;
    unsure_s_ = 0.0;
    return JudgePlace(seen);
  }
  unsure_m_ += moved ? std::abs(moved->distance_m) : 0.0;
  unsure_s_ += seen.dt_s;
  const bool gone = seen.agreeing < options_.min_features;
  covered_ = covered_ || (gone && sure_once_ && moved && CoveredNow(seen));
  // Whatever hides the segment's features does not hide the view yet. The earlier good view is
  // still remembered, since a person who steps in front of the camera takes a moment to cover all
  // of it.
  if (seen.recognised || seen.glimpsed || seen.elsewhere) covered_ = false;
  if (covered_) since_covered_s_ = 0.0;
  const bool by_distance = moved.has_value() && sure_once_;
  const Trust trust = Decide(seen, by_distance);
  if (trust != Trust::kLost || covered_ || !seen.recognised) {
    return {trust, Explain(seen, by_distance)};
  }
  sure_once_ = recognised_only_ = true;
  return {Trust::kUnsure, Explain(seen, by_distance) + "; steers by the view as a whole"};
}

}  // namespace trailcast::agent
