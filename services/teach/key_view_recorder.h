#pragma once

#include <cstddef>

#include "services/route/key_view.h"
#include "services/view/view_table.h"

namespace trailcast::teach {

struct KeyViewRecorderOptions {
  // So many features of a view are kept. With twice as many as tell when the next view is due, a
  // follower recognises a place from another side, or through another lens, that it does not
  // recognise with half.
  std::size_t features = 80;
  // So many of a view tell when the next one is due, so that keeping more of each does not move
  // them apart.
  std::size_t compared = 40;
  // A view with fewer features than this is none: it is too dark or too bland.
  std::size_t fewest = 8;
  // The next view is kept when a smaller share of the last one's features is recognised.
  double recognised_share = 0.5;
  // So many of a view's features are from the middle of the picture, half as wide and high, which
  // is all that a camera with a narrow view sees of it.
  std::size_t middle_features = 0;

  // Returns options for routes with odometry, whose followers know their place roughly. Its views
  // take a quarter of the bytes.
  [[nodiscard]] static KeyViewRecorderOptions WithOdometry() {
    return {.features = 32, .compared = 32, .recognised_share = 0.4, .middle_features = 13};
  }
};

// This is why followers may not recognise their place by the present frame.
enum class ViewWeakness {
  kNone,
  kBland,      // too few features: dark, blank, out of focus
  kUnrelated,  // next to nothing of the last picture is recognised: too fast for the frame rate
};

// This chooses, while a robot is taught, the views by which followers will recognise their place.
// It keeps as many as it takes for each frame in between to be recognised by one of its neighbours.
class KeyViewRecorder {
 public:
  // `width_px` is the width of the scout's frames.
  explicit KeyViewRecorder(int width_px, const KeyViewRecorderOptions& options = {})
      : options_(options), width_px_(width_px) {}

  // Adds the present frame's view, the strongest features first. Returns whether the frame becomes
  // a key view, which `kept` then returns.
  [[nodiscard]] bool Add(const route::View& view);
  // Keeps the view whatever is recognised, unless it has too few features. This is for the route's
  // end.
  [[nodiscard]] bool Keep(const route::View& view);
  [[nodiscard]] const route::View& kept() const { return kept_; }

  // Returns the share of the last key view's features that was recognised in the last frame added.
  // It is 0 if the frame has too few features.
  [[nodiscard]] double recognised() const { return recognised_; }
  [[nodiscard]] ViewWeakness weakness() const { return weakness_; }

 private:
  [[nodiscard]] route::View Choose(const route::View& view) const;

  KeyViewRecorderOptions options_;
  int width_px_;
  route::View kept_;
  view::ViewTable table_;  // of the last key view, as it is compared
  double recognised_ = 0.0;
  int since_kept_ = 0;  // in frames
  ViewWeakness weakness_ = ViewWeakness::kNone;
};

}  // namespace trailcast::teach
