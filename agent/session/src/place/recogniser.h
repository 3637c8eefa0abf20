#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "services/belief/route_belief.h"
#include "services/image/image.h"
#include "services/route/route.h"
#include "services/view/view_table.h"
#include "services/vision/view_features.h"
#include "services/vision/view_fit.h"

namespace trailcast::agent {

// This is what was recognised of the route in one frame.
struct Look {
  struct Recognised {
    std::size_t view = 0;  // position among the route's key views
    view::Comparison comparison;
  };
  view::ViewTable seen;  // the frame's own features
  std::vector<Recognised> views;
  int width_px = 0;  // width of the frame

  // Returns the one with the most features that agree, or null if none was compared.
  [[nodiscard]] const Recognised* Best() const;
};

// This compares a camera's pictures with the route's key views, which are all of one scout's
// camera.
class Recogniser {
 public:
  explicit Recogniser(int scout_width_px) : scout_width_px_(scout_width_px) {}

  // Takes the route's next key views. Returns the logarithm of how much larger each of the scout's
  // shows things than the one before it, or nothing if they have too little in common, or if a
  // follower added it.
  std::vector<std::optional<double>> Learn(std::span<const route::KeyView> views);
  // `width_px` is of the frame that `picture` is, or was reduced from (vision::ViewPicture).
  [[nodiscard]] Look LookAt(const image::GrayImage& picture, int width_px,
                            std::span<const std::size_t> views);
  // Does the same for a picture that this camera did not take, or not as it is mounted.
  [[nodiscard]] Look Glance(const image::GrayImage& picture,
                            std::span<const std::size_t> views) const;
  [[nodiscard]] int scout_width_px() const { return scout_width_px_; }
  [[nodiscard]] const view::ViewTable& key(std::size_t view) const { return keys_[view]; }

  // Returns a look's comparisons for the belief.
  [[nodiscard]] std::vector<belief::ComparedView> Compared(const Look& look) const;
  // Returns how the scout's picture maps onto this one by what was recognised, in pixels.
  [[nodiscard]] vision::ViewFit FitOf(const Look& look, const view::Comparison& comparison) const;

 private:
  [[nodiscard]] Look Compare(view::ViewTable seen, int width_px,
                             std::span<const std::size_t> views) const;

  int scout_width_px_;
  vision::ViewDescriber describer_;
  std::vector<view::ViewTable> keys_;
  std::optional<std::size_t> last_own_;  // the scout's last one among these
};

}  // namespace trailcast::agent
