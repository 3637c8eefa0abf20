#include "agent/session/src/place/place_trust.h"

#include <fmt/format.h>

namespace trailcast::agent {

Verdict PlaceTrust::Judge(const belief::RouteBelief::Place& place, double dt_s,
                          std::string_view doubt) {
  if (place.held && doubt.empty()) {
    ever_sure_ = true;
    unsure_s_ = 0.0;
    return {Trust::kSure, ""};
  }
  unsure_s_ += dt_s;
  const std::string why =
      place.held
          ? std::string(doubt)
          : fmt::format(
                "{} for {:.1f} s: {} features of the likeliest place in view, off the "
                "route with {:.0f} %",
                ever_sure_ ? "the place on the route is not known" : "the route is not recognised",
                unsure_s_, place.agreed, 100.0 * place.off_route);
  if (unsure_s_ > options_.limit_s + kTimeSlack_s) return {Trust::kLost, why};
  return {ever_sure_ ? Trust::kBlind : Trust::kSeeking, why};
}

}  // namespace trailcast::agent
