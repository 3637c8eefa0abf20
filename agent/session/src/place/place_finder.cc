#include "agent/session/place_finder.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace trailcast::agent {
namespace {

// These are metres from where it was left. More of them are ahead: the noted place may be a second
// old, and a robot whose agent was killed rolls on for a while.
constexpr std::array kAround_m = {0.0, 0.2, -0.2, 0.4, -0.4, 0.6, 0.8, 1.0, 1.2, 1.4, 1.6};
// A robot whose camera is not known may be at so many of these.
constexpr std::size_t kToldPlaces = 5;
// It is there if it sees this many, and this share, of the features that should be in its picture:
// more than at a hand-over, where it is known to be near.
constexpr std::size_t kLeastFeatures = 8;
constexpr std::size_t kLeastFeaturesWhereRecognised = 5;
constexpr double kRecognised_m = 2.0;
constexpr double kLeastShare = 0.6;
// If everything looks this much larger or smaller than it should, it is another place.
constexpr double kOtherSize = 0.2;

struct PlaceInRoute {
  const route::Segment* segment = nullptr;
  double fraction = 0.0;
};

// Returns nothing for a place that is not on the route, or not known yet.
std::optional<PlaceInRoute> PlaceAt(std::span<const route::Segment> segments, double along_m) {
  if (along_m < 0.0) return std::nullopt;
  for (const route::Segment& segment : segments) {
    if (along_m < segment.length_m) return PlaceInRoute{&segment, along_m / segment.length_m};
    along_m -= segment.length_m;
  }
  return std::nullopt;
}

double Share(const vision::FindResult& seen) {
  return static_cast<double>(seen.features.size()) / std::max(1, seen.in_picture);
}

bool IsThere(const vision::FindResult& seen, bool recognised) {
  const std::size_t least = recognised ? kLeastFeaturesWhereRecognised : kLeastFeatures;
  return seen.BeyondChance() && seen.features.size() >= least && Share(seen) >= kLeastShare;
}

}  // namespace

double PlaceFinder::Likeness(const Found& found) const {
  const double other_size = std::abs(std::log(found.seen.magnification / *left_.magnification));
  return Share(found.seen) * std::max(0.0, 1.0 - other_size / kOtherSize);
}

std::optional<PlaceFinder::Found> PlaceFinder::LookFrom(const image::GrayImage& frame,
                                                        std::span<const route::Segment> segments,
                                                        const HandOver& hand_over, double along_m) {
  const auto place = PlaceAt(segments, along_m);
  if (!place) return std::nullopt;
  // A place where nothing was found is tried again with grown patterns and, if an operator told it,
  // at any magnification.
  const bool again = rounds_ > 0;
  const auto magnification = told_ && again ? std::nullopt : left_.magnification;
  const auto see = [&](bool grown) {
    return hand_over.SeeFrom(frame, *place->segment, place->fraction, magnification, grown);
  };
  const bool grows = again && magnification;
  Found found{place->segment->index, place->fraction, see(grows)};
  if (!magnification) {  // the right one finds more of them
    vision::FindResult grown = see(true);
    if (grown.AboveChance() > found.seen.AboveChance()) found.seen = std::move(grown);
  }
  if (!most_seen_ || Share(found.seen) > Share(most_seen_->seen)) most_seen_ = found;
  return found;
}

std::optional<PlaceFinder::Found> PlaceFinder::Look(const image::GrayImage& frame,
                                                    std::span<const route::Segment> segments,
                                                    const HandOver& hand_over,
                                                    std::optional<double> recognised_m) {
  if (given_up()) return std::nullopt;
  const bool at_start = !told_ && turn_ == kAround_m.size();
  const double along_m = at_start ? 0.0 : left_.along_m + kAround_m.at(turn_);
  auto found = LookFrom(frame, segments, hand_over, along_m);
  const bool recognised = recognised_m && std::abs(*recognised_m - along_m) < kRecognised_m;
  if (found && IsThere(found->seen, recognised)) {
    if (told_) return found;
    // It is back at the start only if it is nowhere around the other place.
    const bool likest = !likest_ || (!at_start && Likeness(*found) > Likeness(*likest_));
    if (Likeness(*found) > 0.0 && likest) likest_ = std::move(found);
  }
  const bool last = told_ ? turn_ + 1 == kToldPlaces : at_start;
  turn_ = last ? 0 : turn_ + 1;
  if (!last) return std::nullopt;
  ++rounds_;
  return std::exchange(likest_, std::nullopt);
}

std::string PlaceFinder::MostSeen() const {
  if (!most_seen_) return "nothing";
  return fmt::format("{} of {} features of segment {}", most_seen_->seen.features.size(),
                     most_seen_->seen.in_picture, most_seen_->segment.value());
}

}  // namespace trailcast::agent
