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

// What was recognised of the route in one frame.
struct Look {
  struct Recognised {
    std::size_t view = 0;  // position among the route's key views
    view::Comparison comparison;
  };
  view::ViewTable seen;  // the frame's own features
  std::vector<Recognised> views;
  int width_px = 0;  // of the frame

  // For the belief.
  [[nodiscard]] std::vector<belief::ComparedView> Compared() const;
  // The one with the most features that agree; nullptr: none was compared.
  [[nodiscard]] const Recognised* Best() const;
};

// Compares what a camera sees with the route's key views, all of one scout's camera.
class Recogniser {
 public:
  explicit Recogniser(int scout_width_px) : scout_width_px_(scout_width_px) {}

  // The route's next key views. By how much of its logarithm each of the scout's shows things
  // larger than the one before it; nothing where they have too little in common, and of those that
  // followers added.
  std::vector<std::optional<double>> Learn(std::span<const route::KeyView> views);
  // `width_px`: of the frame that `picture` is, or was reduced from (vision::ViewPicture).
  [[nodiscard]] Look LookAt(const image::GrayImage& picture, int width_px,
                            std::span<const std::size_t> views);
  // The same of a picture that is none of this camera's as it is mounted.
  [[nodiscard]] Look Glance(const image::GrayImage& picture,
                            std::span<const std::size_t> views) const;
  [[nodiscard]] int scout_width_px() const { return scout_width_px_; }
  [[nodiscard]] const view::ViewTable& key(std::size_t view) const { return keys_[view]; }

  // How the scout's picture maps onto this one, by what was recognised; in pixels.
  [[nodiscard]] vision::ViewFit FitOf(const Look& look, const view::Comparison& comparison) const;

 private:
  [[nodiscard]] Look Compare(view::ViewTable seen, int width_px,
                             std::span<const std::size_t> views) const;

  int scout_width_px_;
  vision::ViewDescriber describer_;
  std::vector<view::ViewTable> keys_;
  std::optional<std::size_t> last_own_;  // of these, the scout's last
};

}  // namespace trailcast::agent
