#pragma once

#include <memory>

#include "services/image/image.h"
#include "services/route/key_view.h"

namespace trailcast::vision {

struct ViewFeatureOptions {
  // Every picture is looked at with about so many pixels, whatever its own size: two cameras of one
  // field of view then see things equally large, and a step costs the same.
  int pixels = 240 * 180;
  int most_features = 300;
  int levels = 6;  // of the pyramid, each smaller by `level_step`: nearer and other cameras
  float level_step = 1.2F;
  int least_contrast_grey = 7;  // of a corner against what surrounds it: dusk has no more
};

// Makes of each frame one of as many pixels as views are looked at with. A smaller one stays as it
// is.
class ViewPicture {
 public:
  // Valid until the next call; `frame` itself where nothing is to be done.
  [[nodiscard]] const image::GrayImage& Reduce(const image::GrayImage& frame);

 private:
  image::GrayImage reduced_;
};

// What a frame shows, to recognise it by: upright ORB features over a pyramid (Rublee et al. 2011,
// without their rotation: robots stand upright), the strongest first. Not of the black surround
// that some lenses leave: what has been black in all pictures of this size so far. Nothing of a
// picture that is too small, or has nothing to hold on to. Deterministic; not thread-safe.
class ViewDescriber {
 public:
  explicit ViewDescriber(const ViewFeatureOptions& options = {});
  ~ViewDescriber();
  ViewDescriber(ViewDescriber&&) noexcept;
  ViewDescriber& operator=(ViewDescriber&&) noexcept;

  // A donut (donut.h) is to be unrolled before.
  [[nodiscard]] route::View Describe(const image::GrayImage& frame);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

// One frame as a catalog is asked for it, unrolled if it is a donut; at most
// route::kMaxViewFeatures. First, spread over the picture and without their sizes, what a scout's
// camera like it would keep; then, with sizes, features of the picture enlarged 2.5 times and
// reduced down to a fifth of what ViewDescriber looks at, for a scout with another camera to have
// seen things as large: the strong half of them and then the others, each by size.
[[nodiscard]] route::View DescribeForQuery(const image::GrayImage& frame);

}  // namespace trailcast::vision
