#pragma once

#include <memory>
#include <vector>

#include "services/image/image.h"
#include "services/route/tracked_feature.h"

namespace trailcast::vision {

struct FeatureTrackerOptions {
  int max_features = 60;  // the paper's figure
  // The smallest eigenvalue accepted, as a share of the image's best (Shi & Tomasi 1994).
  double detection_quality = 0.01;
  // Features are spread over the image: no two are closer than this share of the distance that
  // max_features on a regular grid would have.
  double min_spacing_share = 0.35;
  double middle_share = 0.25;  // share of width and height that is the picture's middle, for Detect
  int window_px = 7;           // the paper's figure
  int pyramid_levels = 3;      // beyond the full image; good for motions up to about 40 px between
                               // frames
  // A turn moves features by this share of the width for each radian, as with a usual webcam.
  // Motions below the second value are found without a prediction.
  double turn_share = 0.87;
  double turn_least_px = 12.0;
  // A feature that is tracked forward and back again must return to its origin this closely.
  double forward_backward_px = 0.7;
};

// The reasons for which a frame lost features.
struct TrackLosses {
  int left_picture = 0;
  int not_returned = 0;  // failed the check forward and backward: covered, blurred or slid off
};

// Follows Shi-Tomasi features from frame to frame by pyramidal KLT. A lost feature vanishes from
// the result and never comes back. It seeks none in the black surround that some lenses leave,
// which has been black in all frames so far. All frames must have the size of the first. It is
// deterministic.
class FeatureTracker {
 public:
  explicit FeatureTracker(const FeatureTrackerOptions& options = {});
  ~FeatureTracker();
  FeatureTracker(FeatureTracker&&) noexcept;
  FeatureTracker& operator=(FeatureTracker&&) noexcept;

  // Takes the next frame and finds the current features in it; the first frame has none.
  // `turned_rad` is the robot's turn since the last frame by odometry, counter-clockwise positive.
  // A turn that moves features further than they can be followed, as happens at few frames a
  // second, tells where about to look for them.
  std::vector<route::TrackedFeature> Track(const image::GrayImage& frame, double turned_rad = 0.0);

  // Drops the current features and detects new ones in the last frame, ids from 0, spread over the
  // picture. If fewer than `in_the_middle` of them are in its middle, it detects more there, closer
  // together, because a camera with a narrower view sees nothing else.
  std::vector<route::TrackedFeature> Detect(int in_the_middle = 0);

  // Continues with these features at these places of the last frame, after a hand-over.
  void Follow(const std::vector<route::TrackedFeature>& features);

  // Sets how many times larger the features' patterns appear here than where they were detected. A
  // camera that magnifies more than the scout's sees little but noise in a window of the usual
  // size.
  void SetMagnification(double magnification);

  // Returns the features that are followed at present, in the last frame.
  [[nodiscard]] std::vector<route::TrackedFeature> Current() const;
  [[nodiscard]] int count() const;
  // Returns the losses of the last Track.
  [[nodiscard]] TrackLosses losses() const;

  // Returns the current features' appearance in the last frame, without those too near its edge.
  // `magnification` describes them for a camera that shows things that many times smaller.
  [[nodiscard]] std::vector<route::DescribedFeature> Describe(double magnification = 1.0) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace trailcast::vision
