#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace trailcast::route {

// What a scout felt of the ground under a segment. Each is nothing where it is not known: in
// segments of before, with too few features, without an IMU.
struct Terrain {
  // By the features: how far they shake up and down together, RMS of what is faster than about half
  // a second, as a share of the picture's height. Of a camera that looks wider the same shaking is
  // less of its picture: a rough measure only.
  std::optional<double> shake{};
  // By an IMU: RMS of the acceleration along gravity, less gravity, at the taught speed.
  std::optional<double> vertical_mps2{};
  // By an IMU: mean pitch of the base along the way, uphill positive. Pictures do not tell it.
  std::optional<double> slope_rad{};

  [[nodiscard]] bool known() const { return shake || vertical_mps2 || slope_rad; }
  bool operator==(const Terrain&) const = default;
};

// How rough that is. By the acceleration, where it is known: the borders are where ISO 2631-1 has
// people who ride on it a little uncomfortable, uncomfortable, and very uncomfortable. By the
// shaking otherwise, whose borders are our own (docs/reference/agent.md): it may be a class off.
enum class Roughness : std::uint8_t { kSmooth, kUneven, kRough, kVeryRough };

struct RoughnessClass {
  Roughness roughness = Roughness::kSmooth;
  std::string_view name;
  // Up to these; of the last class there is no such end.
  double most_mps2 = 0.0;
  double most_shake = 0.0;
};
[[nodiscard]] const std::array<RoughnessClass, 4>& RoughnessClasses();

[[nodiscard]] std::string_view NameOf(Roughness roughness);
[[nodiscard]] std::optional<Roughness> FindRoughness(std::string_view name);
// Nothing: neither is known.
[[nodiscard]] std::optional<Roughness> RoughnessOf(const Terrain& terrain);

}  // namespace trailcast::route
