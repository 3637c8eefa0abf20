#include "services/vision/view_features.h"

#include "services/vision/donut.h"
#include "services/vision/feature_tracker.h"

namespace trailcast::vision {

route::View DescribeView(const image::GrayImage& frame) {
  FeatureTrackerOptions options;
  options.max_features = static_cast<int>(route::kMaxViewFeatures);
  FeatureTracker tracker(options);
  DonutUnroller unroller;
  tracker.Track(unroller.Unroll(frame));
  tracker.Detect();
  route::View view;
  for (const route::DescribedFeature& feature : tracker.Describe()) {
    if (!route::IsDescribed(feature.descriptor)) continue;
    view.push_back({feature.descriptor, static_cast<float>(feature.at.u_px),
                    static_cast<float>(feature.at.v_px)});
  }
  return view;
}

}  // namespace trailcast::vision
