#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace trailcast::route {

// This is what a scout measured of the ground under a segment. Each value is empty if it is not
// known: in segments of earlier versions, with too few features, or without an IMU.
struct Terrain {
  // This is by the features: the RMS of how far they shake up and down together, faster than about
  // half a second, as a share of the picture's height. For a camera with a wider view the same
  // shaking is a smaller share, so this is a rough measure only.
  std::optional<double> shake{};
  // This is by an IMU: the RMS of the acceleration along gravity, less gravity, at the taught
  // speed.
  std::optional<double> vertical_mps2{};
  // This is by an IMU, as pictures do not tell it: the mean pitch of the base along the path,
  // uphill positive.
  std::optional<double> slope_rad{};

  [[nodiscard]] bool known() const { return shake || vertical_mps2 || slope_rad; }
  bool operator==(const Terrain&) const = default;
};

// This is how rough that is, by the acceleration if it is known. Its limits are those at which ISO
// 2631-1 expects riders to be a little uncomfortable, uncomfortable and very uncomfortable.
// Otherwise it is by the shaking, whose limits are the project's own (docs/reference/agent.md), so
// it may be a class off.
enum class Roughness : std::uint8_t { kSmooth, kUneven, kRough, kVeryRough };

struct RoughnessClass {
  Roughness roughness = Roughness::kSmooth;
  std::string_view name;
  // A class reaches up to these. The last class has no upper limit.
  double most_mps2 = 0.0;
  double most_shake = 0.0;
};
[[nodiscard]] const std::array<RoughnessClass, 4>& RoughnessClasses();

[[nodiscard]] std::string_view NameOf(Roughness roughness);
[[nodiscard]] std::optional<Roughness> FindRoughness(std::string_view name);
// Returns nothing if neither the acceleration nor the shaking is known.
[[nodiscard]] std::optional<Roughness> RoughnessOf(const Terrain& terrain);

}  // namespace trailcast::route
