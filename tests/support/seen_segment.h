#pragma once

#include <cstdint>
#include <random>
#include <utility>

#include "services/route/route.h"
#include "services/route/view.h"

namespace trailcast::test {

// Returns a segment of features that resemble nothing else, spread over a picture of 320 x 240,
// which come nearer along the segment. The same number gives the same segment.
[[nodiscard]] inline route::Segment SegmentToSee(unsigned number, std::uint32_t index,
                                                 int features = 30) {
  std::mt19937 random(number);
  const auto uniform = [&](float low, float high) {
    return low + (high - low) * static_cast<float>(random()) / 4294967296.0F;
  };
  route::Segment segment;
  segment.index = SegmentIndex(index);
  for (int i = 0; i < features; ++i) {
    route::Feature feature;
    for (std::uint8_t& byte : feature.descriptor) byte = static_cast<std::uint8_t>(random());
    const float u_px = uniform(-120.0F, 120.0F);
    const float v_px = uniform(-90.0F, 90.0F);
    feature.track = {{0.0F, u_px, v_px}, {1.0F, 1.2F * u_px, 1.2F * v_px}};
    segment.features.push_back(std::move(feature));
  }
  return segment;
}

struct Seeing {
  int flipped_bits = 30;  // of a descriptor's 256
  float shift_u_px = 12.0F;
  float shift_v_px = -4.0F;
  bool shuffled = false;  // each feature is in another one's place
};

// Returns the segment's beginning as another camera sees it.
[[nodiscard]] inline route::View ViewOf(const route::Segment& segment, const Seeing& seeing = {}) {
  std::mt19937 random(5);
  route::View view;
  for (std::size_t i = 0; i < segment.features.size(); ++i) {
    const std::size_t from = seeing.shuffled ? (i * 7 + 3) % segment.features.size() : i;
    const route::TrackKnot& at = segment.features[from].first();
    route::ViewFeature& seen = view.emplace_back();
    seen.descriptor = segment.features[i].descriptor;
    seen.u_px = at.u_px + seeing.shift_u_px;
    seen.v_px = at.v_px + seeing.shift_v_px;
    for (int flip = 0; flip < seeing.flipped_bits; ++flip) {
      seen.descriptor[random() % seen.descriptor.size()] ^=
          static_cast<std::uint8_t>(1U << (random() % 8U));
    }
  }
  return view;
}

}  // namespace trailcast::test
