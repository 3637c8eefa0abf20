#pragma once

#include <span>

#include "services/route/key_view.h"
#include "services/route/route.h"
#include "services/view/view_match.h"
#include "services/view/view_table.h"

namespace trailcast::view {

// This is a view by a camera of any field of view, ready to be compared with segments. Its features
// must come from its picture enlarged and reduced (vision/view_features.h). It tries every
// magnification of a key view, from 0.2 to 3 in half widths of the pictures, with those features of
// the view alone that are then as large as the key view's. A feature far from that size cannot be
// mistaken for it, which is why many features are worth having.
class AnyCameraView {
 public:
  explicit AnyCameraView(std::span<const route::ViewFeature> view);

  // Returns the match with the most similar of the segment's key views. Key views that are no more
  // similar than unrelated ones may be count as having nothing in common. If the sizes of features
  // are not known, this works as Match().
  [[nodiscard]] ViewMatch MatchWith(const route::Segment& segment) const;

 private:
  bool sized_ = false;  // all of its features have a size
  ViewTable table_;
};

}  // namespace trailcast::view
