#include "services/route/terrain.h"

#include <limits>

namespace trailcast::route {
namespace {

constexpr double kNoEnd = std::numeric_limits<double>::infinity();

}  // namespace

const std::array<RoughnessClass, 4>& RoughnessClasses() {
  static constexpr std::array<RoughnessClass, 4> kClasses = {{
      {Roughness::kSmooth, "smooth", 0.315, 0.005},
      {Roughness::kUneven, "uneven", 0.8, 0.015},
      {Roughness::kRough, "rough", 1.6, 0.04},
      {Roughness::kVeryRough, "very-rough", kNoEnd, kNoEnd},
  }};
  return kClasses;
}

std::string_view NameOf(Roughness roughness) {
  return RoughnessClasses()[static_cast<std::size_t>(roughness)].name;
}

std::optional<Roughness> FindRoughness(std::string_view name) {
  for (const RoughnessClass& each : RoughnessClasses()) {
    if (each.name == name) return each.roughness;
  }
  return std::nullopt;
}

std::optional<Roughness> RoughnessOf(const Terrain& terrain) {
  if (!terrain.vertical_mps2 && !terrain.shake) return std::nullopt;
  for (const RoughnessClass& each : RoughnessClasses()) {
    const bool within = terrain.vertical_mps2 ? *terrain.vertical_mps2 <= each.most_mps2
                                              : *terrain.shake <= each.most_shake;
    if (within) return each.roughness;
  }
  return Roughness::kVeryRough;
}

}  // namespace trailcast::route
