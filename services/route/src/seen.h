#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "services/base/result.h"
#include "services/route/key_view.h"
#include "services/route/route.h"

namespace trailcast::route {

// These are a segment's features and key views in the steps of the route format
// (docs/reference/route-format.md). They are nearly all of a segment's bytes.
struct CodedKnot {
  int time = 0;  // 0 to kLastKnotTime, rising
  std::int32_t u = 0;
  std::int32_t v = 0;
};
struct CodedFeature {
  Patch patch{};
  Descriptor descriptor{};
  std::uint8_t missed = 0;
  std::vector<CodedKnot> track;  // at least two, the first at 0, the last at kLastKnotTime
};
struct CodedViewFeature {
  Descriptor descriptor{};
  std::uint8_t size = 0;
  std::int32_t u = 0;
  std::int32_t v = 0;
};
struct CodedView {
  int at = 0;  // 0 to kLastKnotTime, in rising order
  std::optional<std::uint8_t> missed;
  std::vector<CodedViewFeature> features;
};
struct Seen {
  std::vector<CodedFeature> features;
  std::vector<CodedView> views;
};

inline constexpr int kLastKnotTime = 255;
inline constexpr int kStepsPerPixel = 16;     // of a track
inline constexpr int kStepsPerViewPixel = 4;  // of a key view's place

// Packs without loss. Without features and views it returns no bytes.
[[nodiscard]] std::string Pack(Seen seen);

// Fails with kCorrupt, and what is wrong, for bytes that Pack does not make.
[[nodiscard]] Result<Seen> Unpack(std::string_view bytes);

}  // namespace trailcast::route
