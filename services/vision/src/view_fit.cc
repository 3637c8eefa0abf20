#include "services/vision/view_fit.h"

#include <cmath>
#include <cstddef>
#include <optional>
#include <random>

namespace trailcast::vision {
namespace {

constexpr double kShortestBase_px = 8.0;  // a scale from two features closer than this is noise

// Returns the scale and shift that map two pairs exactly (their scale in the least-squares sense).
std::optional<ViewFit> FitTwo(const ViewPair& a, const ViewPair& b) {
  const double su = b.scout_u_px - a.scout_u_px;
  const double sv = b.scout_v_px - a.scout_v_px;
  const double base = su * su + sv * sv;
  if (base < kShortestBase_px * kShortestBase_px) return std::nullopt;
  const double scale = (su * (b.u_px - a.u_px) + sv * (b.v_px - a.v_px)) / base;
  return ViewFit{scale, a.u_px - scale * a.scout_u_px, a.v_px - scale * a.scout_v_px};
}

bool Belongs(const ViewPair& pair, const ViewFit& fit, const ViewFitOptions& options) {
  return std::abs(pair.u_px - fit.MapU(pair.scout_u_px)) <= options.tolerance_u_px &&
         std::abs(pair.v_px - fit.MapV(pair.scout_v_px)) <= options.tolerance_v_px;
}

bool IsWithin(const ViewFit& fit, const ViewFitOptions& options) {
  return fit.scale >= options.min_scale && fit.scale <= options.max_scale;  // false for NaN
}

ViewFit LeastSquares(const std::vector<ViewPair>& pairs, const std::vector<bool>& use) {
  double n = 0;
  ViewPair mean;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (!use[i]) continue;
    n += 1;
    mean.scout_u_px += pairs[i].scout_u_px;
    mean.scout_v_px += pairs[i].scout_v_px;
    mean.u_px += pairs[i].u_px;
    mean.v_px += pairs[i].v_px;
  }
  mean = {mean.scout_u_px / n, mean.scout_v_px / n, mean.u_px / n, mean.v_px / n};
  double cross = 0;
  double square = 0;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (!use[i]) continue;
    const double su = pairs[i].scout_u_px - mean.scout_u_px;
    const double sv = pairs[i].scout_v_px - mean.scout_v_px;
    cross += su * (pairs[i].u_px - mean.u_px) + sv * (pairs[i].v_px - mean.v_px);
    square += su * su + sv * sv;
  }
  const double scale = square > 0 ? cross / square : 1.0;
  return {scale, mean.u_px - scale * mean.scout_u_px, mean.v_px - scale * mean.scout_v_px};
}

}  // namespace

ViewFitResult FitView(const std::vector<ViewPair>& pairs, const ViewFitOptions& options) {
  ViewFitResult best;
  best.inlier.assign(pairs.size(), false);
  if (pairs.size() < 2) return best;
  std::minstd_rand random(1);
  for (int draw = 0; draw < options.draws; ++draw) {
    const std::size_t a = random() % pairs.size();
    const std::size_t b = random() % pairs.size();
    const auto fit = FitTwo(pairs[a], pairs[b]);
    if (!fit || !IsWithin(*fit, options)) continue;
    std::vector<bool> inlier(pairs.size());
    int inliers = 0;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      inlier[i] = Belongs(pairs[i], *fit, options);
      inliers += inlier[i] ? 1 : 0;
    }
    if (inliers > best.inliers) best = {*fit, std::move(inlier), inliers};
  }
  if (best.inliers < 2) return best;
  // Pairs that lie close together for their tolerance can pull the scale anywhere, even below zero.
  const ViewFit refined = LeastSquares(pairs, best.inlier);
  if (IsWithin(refined, options)) best.fit = refined;
  return best;
}

}  // namespace trailcast::vision
