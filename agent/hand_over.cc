#include "agent/hand_over.h"

#include <algorithm>

namespace trailcast::agent {
namespace {

constexpr std::size_t kEnoughToLearn = 10;  // a magnification from fewer is too noisy
constexpr std::size_t kMagnificationsKept = 15;
constexpr double kEnoughShare = 0.4;  // found near by: the wide search is not needed
constexpr std::size_t kEnoughToRecover = 10;

}  // namespace

HandOver::HandOver(ReplayMethod method, int scout_width_px, int width_px)
    : any_camera_(method != ReplayMethod::kPaper),
      magnification_(static_cast<double>(width_px) / scout_width_px) {}

vision::FindResult HandOver::Find(const image::GrayImage& frame,
                                  std::span<const route::Feature> sought, double s,
                                  bool wide) const {
  vision::FindResult near = finder_.FindNear(frame, sought, s, {magnification_, 0.0, 0.0});
  const double share =
      static_cast<double>(near.features.size()) / static_cast<double>(sought.size());
  if (!wide || share >= kEnoughShare) return near;
  const vision::FindResult coarse = finder_.FindWide(frame, sought, s);
  if (coarse.features.empty()) return near;
  vision::FindResult refined = finder_.FindNear(frame, sought, s, coarse.fit);
  return refined.features.size() > near.features.size() ? refined : near;
}

std::vector<route::TrackedFeature> HandOver::ToSegment(const image::GrayImage& frame,
                                                       const route::Segment& segment) {
  if (segment.features.empty()) return {};
  vision::FindResult found = Find(frame, segment.features, 0.0, any_camera_);
  Learn(found.fit, found.features.size());
  share_sum_ +=
      static_cast<double>(found.features.size()) / static_cast<double>(segment.features.size());
  ++count_;
  return std::move(found.features);
}

std::vector<route::TrackedFeature> HandOver::Again(const image::GrayImage& frame,
                                                   const route::Segment& segment, double s) const {
  return Find(frame, segment.features, s, /*wide=*/false).features;
}

// The magnification as a running median: one bad fit does no harm.
void HandOver::Learn(const vision::ViewFit& fit, std::size_t features) {
  if (!any_camera_ || features < kEnoughToLearn) return;
  seen_magnifications_.push_back(fit.scale);
  if (seen_magnifications_.size() > kMagnificationsKept) seen_magnifications_.pop_front();
  std::vector<double> sorted(seen_magnifications_.begin(), seen_magnifications_.end());
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  magnification_ = *middle;
}

std::optional<HandOver::Recovered> HandOver::Recover(const image::GrayImage& frame,
                                                     std::span<const route::Segment> ahead) const {
  Recovered best;
  for (std::size_t i = 0; i < ahead.size(); ++i) {
    for (const double s : {0.0, 0.5, 1.0}) {
      if (ahead[i].features.empty() || (i > 0 && s > 0.0)) continue;
      vision::FindResult found = Find(frame, ahead[i].features, s, any_camera_);
      if (found.features.size() > best.features.size()) best = {i, std::move(found.features)};
    }
  }
  if (best.features.size() < kEnoughToRecover) return std::nullopt;
  return best;
}

std::vector<route::TrackedFeature> HandOver::InScoutPixels(
    std::vector<route::TrackedFeature> features) const {
  for (route::TrackedFeature& feature : features) {
    feature.u_px /= magnification_;
    feature.v_px /= magnification_;
  }
  return features;
}

}  // namespace trailcast::agent
