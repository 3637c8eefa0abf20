#pragma once

#include <vector>

#include "services/base/result.h"
#include "services/image/image.h"

namespace trailcast::photos {

// A part of a photo that looks otherwise than at an earlier visit, in pixels from its upper left
// corner.
struct ChangedRegion {
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;
  double contrast = 0.0;  // mean difference in grey levels
};

// Two photos of one spot, as the later one's camera saw it.
struct Comparison {
  // The earlier photo, moved so that it lies over the later one. Where that has no part, it is 0.
  image::GrayImage earlier{};
  double overlap = 0.0;  // share of the later photo that has such a part
  int agreeing = 0;      // features that both have
  // The most striking first, at most kMostRegions.
  std::vector<ChangedRegion> changes{};
};

inline constexpr std::size_t kMostRegions = 12;

// Aligns an earlier photo with a later one by their ORB features and a homography (RANSAC), and
// marks what has changed: what is unlike everything nearby in the other photo, beyond the light as
// a whole. Fails with kConflict, which says why, if the two do not show the same from nearly the
// same place, or nearly all of it has changed. Changes that are smaller than a thirtieth of the
// picture, or fainter than what parallax and light leave, are not found.
[[nodiscard]] Result<Comparison> Compare(const image::GrayImage& earlier,
                                         const image::GrayImage& later);

}  // namespace trailcast::photos
