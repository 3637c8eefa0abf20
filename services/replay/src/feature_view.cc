#include "services/replay/feature_view.h"

#include <cmath>

#include "services/replay/funnel_lane.h"
#include "services/replay/roll.h"

namespace trailcast::replay {
namespace {

FeatureVerdict Judge(const FeatureView& view, double roll_rad, double outlier_px) {
  const double apart_px =
      std::hypot(view.at.u_px - view.expected.u_px, view.at.v_px - view.expected.v_px);
  if (apart_px >= outlier_px) return FeatureVerdict::kRejected;
  const Eigen::Vector2d upright = Unroll({view.at.u_px, view.at.v_px}, roll_rad);
  const FunnelPair pair{upright.x(), view.milestone.u_px};
  if (InsideFunnel(pair)) return FeatureVerdict::kInside;
  const double turn = FeatureTurn(pair, 1.0);
  if (turn == 0.0) return FeatureVerdict::kInside;  // on the funnel's border
  return turn > 0.0 ? FeatureVerdict::kAsksRight : FeatureVerdict::kAsksLeft;
}

}  // namespace

std::vector<FeatureView> ViewFeatures(const Follower& follower,
                                      const std::vector<route::TrackedFeature>& seen,
                                      double roll_rad) {
  const std::vector<route::TrackedFeature> expected = follower.Expect();
  const std::vector<route::TrackedFeature> milestone = follower.ExpectAtMilestone();
  const double outlier_px = follower.magnification() * follower.outlier_px();
  std::vector<FeatureView> views;
  views.reserve(seen.size());
  for (const route::TrackedFeature& at : seen) {
    const auto index = static_cast<std::size_t>(at.id);
    FeatureView view{at, expected.at(index), milestone.at(index)};
    view.verdict = Judge(view, roll_rad, outlier_px);
    views.push_back(view);
  }
  return views;
}

}  // namespace trailcast::replay
