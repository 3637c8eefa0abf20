#pragma once

#include <memory>
#include <vector>

#include "services/image/image.h"
#include "services/route/tracked_feature.h"

namespace trailcast::vision {

struct FeatureTrackerOptions {
  int max_features = 60;  // the paper's figure
  // Smallest eigenvalue accepted, as a share of the image's best (Shi & Tomasi 1994).
  double detection_quality = 0.01;
  // Features are spread over the image: no two closer than this share of the distance that
  // max_features on a regular grid would have.
  double min_spacing_share = 0.35;
  double middle_share = 0.25;  // of width and height: the picture's middle, for Detect
  int window_px = 7;           // the paper's figure
  int pyramid_levels = 3;      // beyond the full image: motions up to about 40 px between frames
  // A turn is believed to move features by this share of the width for each radian, as with a usual
  // webcam, once that is more than so many pixels: that far they are found without.
  double turn_share = 0.87;
  double turn_least_px = 12.0;
  // A feature tracked forward and back again must return to where it came from this closely.
  double forward_backward_px = 0.7;
};

// What became of the features that a frame lost.
struct TrackLosses {
  int left_picture = 0;
  int not_returned = 0;  // failed the check forward and backward: covered, blurred, slid off
};

// Shi-Tomasi features followed from frame to frame by pyramidal KLT. A lost feature vanishes from
// the result and never comes back. None are sought in the black surround that some lenses leave,
// which has been black in all frames so far. All frames must have the size of the first.
// Deterministic.
class FeatureTracker {
 public:
  explicit FeatureTracker(const FeatureTrackerOptions& options = {});
  ~FeatureTracker();
  FeatureTracker(FeatureTracker&&) noexcept;
  FeatureTracker& operator=(FeatureTracker&&) noexcept;

  // Takes the next frame and finds the current features in it. The first frame gives none.
  // `turned_rad`: what odometry says that the robot turned meanwhile, counter-clockwise positive. A
  // turn that moves features further than they can be followed, at few frames a second, says where
  // about to look for them.
  std::vector<route::TrackedFeature> Track(const image::GrayImage& frame, double turned_rad = 0.0);

  // Forgets the current features and detects new ones in the last frame, ids from 0: those spread
  // over the picture and, where fewer than `in_the_middle` of them are in its middle, more there,
  // closer together; that is all that a camera with a narrower view would see of it.
  std::vector<route::TrackedFeature> Detect(int in_the_middle = 0);

  // Goes on with these features at these places of the last frame (hand-over).
  void Follow(const std::vector<route::TrackedFeature>& features);

  // The features' patterns are so many times larger here than where they were detected: a camera
  // that magnifies more than the scout's sees little but noise in a window of the usual size.
  void SetMagnification(double magnification);

  // Those followed at present, in the last frame.
  [[nodiscard]] std::vector<route::TrackedFeature> Current() const;
  [[nodiscard]] int count() const;
  // Of the last Track.
  [[nodiscard]] TrackLosses losses() const;

  // What the current features look like in the last frame; those too near its edge are left out.
  // `magnification`: as they look to a camera that shows things so many times smaller.
  [[nodiscard]] std::vector<route::DescribedFeature> Describe(double magnification = 1.0) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace trailcast::vision
