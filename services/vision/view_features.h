#pragma once

#include <memory>

#include "services/image/image.h"
#include "services/route/key_view.h"

namespace trailcast::vision {

struct ViewFeatureOptions {
  // Every picture is reduced to about this many pixels, so that two cameras of one field of view
  // see things equally large and a step costs the same.
  int pixels = 240 * 180;
  int most_features = 300;
  int levels = 6;  // of the pyramid, each smaller by `level_step`, for nearer views and other
                   // cameras
  float level_step = 1.2F;
  int least_contrast_grey = 7;  // of a corner against its surroundings: dusk has no more
};

// Reduces each frame to the size at which views are described. A smaller one stays as it is.
class ViewPicture {
 public:
  // Returns a picture that is valid until the next call, or `frame` itself if nothing is to be
  // done.
  [[nodiscard]] const image::GrayImage& Reduce(const image::GrayImage& frame);

 private:
  image::GrayImage reduced_;
};

// Describes a frame by features that allow it to be recognised: upright ORB features over a pyramid
// (Rublee et al. 2011, without their rotation, because robots stand upright), the strongest first.
// It finds none in the black surround that some lenses leave, which has been black in all pictures
// of this size so far. A picture that is too small or has no structure gives none. It is
// deterministic and not thread-safe.
class ViewDescriber {
 public:
  explicit ViewDescriber(const ViewFeatureOptions& options = {});
  ~ViewDescriber();
  ViewDescriber(ViewDescriber&&) noexcept;
  ViewDescriber& operator=(ViewDescriber&&) noexcept;

  // Takes an unrolled picture if the camera shows a donut (donut.h).
  [[nodiscard]] route::View Describe(const image::GrayImage& frame);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

// Describes one frame for a query to a catalog; a donut must be unrolled. It returns at most
// route::kMaxViewFeatures. The first ones are spread over the picture and have no sizes, as a scout
// with a camera like this one would keep them. The others have sizes. They come from the picture
// enlarged 2.5 times and reduced down to a fifth of what ViewDescriber looks at, so that a scout
// with another camera has seen things as large: the strong half of them first, then the rest, each
// half by size.
[[nodiscard]] route::View DescribeForQuery(const image::GrayImage& frame);

}  // namespace trailcast::vision
