#pragma once

#include <span>

#include "services/route/key_view.h"
#include "services/route/route.h"
#include "services/view/view_match.h"
#include "services/view/view_table.h"

namespace trailcast::view {

// A view by a camera of any field of view, ready to be compared with segments. Its features are to
// be those of its picture enlarged and reduced (vision/view_features.h): every magnification of a
// key view, by 0.2 to 3 times in half widths of the pictures, is tried with those of the view's
// features only that are then as large as the key view's. What is far from that size cannot be
// mistaken for it, which is what makes many features worth having.
class AnyCameraView {
 public:
  explicit AnyCameraView(std::span<const route::ViewFeature> view);

  // The likest of the segment's key views; nothing in common with those that are less alike than
  // strangers may be. Where the sizes of features are not known, as Match().
  [[nodiscard]] ViewMatch MatchWith(const route::Segment& segment) const;

 private:
  bool sized_ = false;  // all of them
  ViewTable table_;
};

}  // namespace trailcast::view
