#include "agent/session/end_finder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "services/view/view_match.h"

namespace trailcast::agent {
namespace {

// This is fewer than where a follower was left (place_finder.cc), since the view as a whole has to
// agree too.
constexpr std::size_t kLeastFeatures = 5;
constexpr double kLeastShare = 0.6;
// The features grow to the size that they had at the end as the robot drives towards it. A fit is
// exact to a hundredth or so; one in fifty is a tenth of a metre before a wall five metres away.
constexpr double kLeastSize = 0.98;
constexpr double kMostSize = 1.04;

double Share(const vision::FindResult& seen) {
  return static_cast<double>(seen.features.size()) / std::max(1, seen.in_picture);
}

}  // namespace

EndFinder::EndFinder(route::Segment last, int width_px, const vision::IntakeOptions& intake)
    : last_(std::move(last)), hand_over_(/*any_camera=*/true, width_px), intake_(intake) {}

bool EndFinder::Look(const image::GrayImage& picture) {
  const image::GrayImage& frame = intake_.Take(picture);
  vision::FindResult seen = hand_over_.SeeFrom(frame, last_, 1.0, 1.0, /*grown=*/false);
  vision::FindResult grown = hand_over_.SeeFrom(frame, last_, 1.0, 1.0, /*grown=*/true);
  if (grown.features.size() > seen.features.size()) seen = std::move(grown);
  if (seen.features.size() > most_seen_.features.size()) most_seen_ = seen;
  const bool there = seen.BeyondChance() && seen.features.size() >= kLeastFeatures &&
                     Share(seen) >= kLeastShare && seen.magnification >= kLeastSize &&
                     seen.magnification <= kMostSize;
  return there && view::Match(describer_.Describe(frame), last_).found();
}

std::string EndFinder::MostSeen() const {
  if (most_seen_.features.empty()) return "nothing of it";
  return fmt::format("{} of {} features, {:.2f} times as large", most_seen_.features.size(),
                     most_seen_.in_picture, most_seen_.magnification);
}

}  // namespace trailcast::agent
