#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace trailcast::route {

// This is an upright (unrotated) ORB descriptor.
using Descriptor = std::array<std::uint8_t, 32>;

// Returns false for a feature near a picture's edge, which ORB does not describe: its descriptor is
// all zero.
[[nodiscard]] inline bool IsDescribed(const Descriptor& descriptor) {
  return descriptor != Descriptor{};
}

// This is a feature of a picture by which the picture is recognised. Its place is in pixels of the
// camera that saw it, from the image centre, u to the right, v down.
struct ViewFeature {
  Descriptor descriptor{};
  float u_px = 0.0F;
  float v_px = 0.0F;
  // One sample of its descriptor spans this many of the picture's pixels, which tells the level of
  // the pyramid at which the feature was found. It is 0 if that is not known.
  float size_px = 0.0F;

  bool operator==(const ViewFeature&) const = default;
};
using View = std::vector<ViewFeature>;

// This is what the scout saw at one moment of a segment, by which a follower finds its place, or
// how the same place looked to a follower later, in the scout's pixels. A follower's view comes
// right after the scout's own.
struct KeyView {
  double s = 0.0;  // fraction of the segment, 0 to 1
  View features;
  // For a view that a follower added, this many of the last visits in a row did not recognise it.
  // The scout's own views have none.
  std::optional<std::uint8_t> missed{};

  bool operator==(const KeyView&) const = default;
};

}  // namespace trailcast::route
