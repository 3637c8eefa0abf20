#pragma once

#include <cstdint>

#include "services/route/route.h"

namespace trailcast::route {

// Returns a segment whose numbers all lie on the route format's grid, so that a round trip does not
// change it. It uses plain arithmetic to be the same on every machine, with any random library.
[[nodiscard]] inline Segment SampleSegment(std::uint32_t index, int features, int knots = 3) {
  Segment segment;
  segment.index = SegmentIndex(index);
  segment.has_odometry = true;
  segment.length_m = 3.0625;
  segment.heading_change_rad = -0.125;
  segment.heading_variation_rad = 0.25;
  segment.heading.c = {0.5, -0.25, 0.03125};
  segment.duration_s = 6.125;
  std::uint32_t state = 2009 + index;
  const auto next = [&state] { return (state = state * 1664525U + 1013904223U) >> 16U; };
  for (int i = 0; i < features; ++i) {
    Feature feature;
    for (std::uint8_t& sample : feature.patch) sample = static_cast<std::uint8_t>(next() % 16U);
    for (std::uint8_t& byte : feature.descriptor) byte = static_cast<std::uint8_t>(next() % 256U);
    // This is anywhere in a 320 x 240 image, and drifts outwards as features ahead of a robot do.
    const float u = static_cast<float>(next() % 4480U) / 16.0F - 140.0F;
    const float v = static_cast<float>(next() % 3200U) / 16.0F - 100.0F;
    for (int k = 0; k < knots; ++k) {
      const int time = 255 * k / (knots - 1);
      const float growth = 1.0F + static_cast<float>(k) / 16.0F;
      const auto on_grid = [growth](float px) {
        return static_cast<float>(static_cast<int>(px * growth * 16.0F)) / 16.0F;
      };
      feature.track.push_back({static_cast<float>(time) / 255.0F, on_grid(u), on_grid(v)});
    }
    segment.features.push_back(feature);
  }
  return segment;
}

// Returns the same segment as it is taught today: with key views, without its features'
// descriptors, and with a turn on the spot before it.
[[nodiscard]] inline Segment SampleSegmentWithKeyViews(std::uint32_t index, int features) {
  Segment segment = SampleSegment(index, features);
  segment.turn_before_rad = 1.57;
  for (const int at : {0, 0, 51, 255}) {
    KeyView& view = segment.key_views.emplace_back();
    view.s = at / 255.0;
    for (Feature& feature : segment.features) {
      const float u = feature.first().u_px * 0.5F;
      const float v = feature.first().v_px + static_cast<float>(at);
      const auto on_grid = [](float px) {
        return static_cast<float>(static_cast<int>(4.0F * px)) / 4.0F;
      };
      view.features.push_back({feature.descriptor, on_grid(u), on_grid(v), at == 51 ? 0.0F : 2.0F});
    }
  }
  for (Feature& feature : segment.features) feature.descriptor = {};
  return segment;
}

[[nodiscard]] inline Segment SampleSegmentDrivenBackwards(std::uint32_t index, int features) {
  Segment segment = SampleSegmentWithKeyViews(index, features);
  segment.turn_before_rad = 0.0;
  segment.reverse = true;
  return segment;
}

}  // namespace trailcast::route
