#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace trailcast::route {

// Upright (unrotated) ORB descriptor.
using Descriptor = std::array<std::uint8_t, 32>;

// ORB describes nothing near a picture's edge: such a feature's descriptor is all zero.
[[nodiscard]] inline bool IsDescribed(const Descriptor& descriptor) {
  return descriptor != Descriptor{};
}

// A feature of a picture, to be recognised by. Pixels of the camera that saw it, from its image
// centre, u to the right, v down.
struct ViewFeature {
  Descriptor descriptor{};
  float u_px = 0.0F;
  float v_px = 0.0F;
  // Of the picture's pixels, how many one sample of its descriptor spans: the level of the pyramid
  // at which it was found. 0: not known.
  float size_px = 0.0F;

  bool operator==(const ViewFeature&) const = default;
};
using View = std::vector<ViewFeature>;

// What the scout saw at one moment of a segment, by which a follower tells where it is; or how the
// same place looked to a follower later, told in the scout's pixels: right after the scout's own.
struct KeyView {
  double s = 0.0;  // fraction of the segment, 0 to 1
  View features;
  // Of one that a follower added: how many of the last visits in a row did not recognise it.
  // Nothing: it is the scout's own.
  std::optional<std::uint8_t> missed{};

  bool operator==(const KeyView&) const = default;
};

}  // namespace trailcast::route
