#include "services/route/terrain_profile.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "services/base/angles.h"

namespace trailcast::route {
namespace {

constexpr double kAsSteep_rad = Radians(1.5);

bool Alike(const Terrain& a, const Terrain& b) {
  if (RoughnessOf(a) != RoughnessOf(b) || a.slope_rad.has_value() != b.slope_rad.has_value()) {
    return false;
  }
  return !a.slope_rad || std::abs(*a.slope_rad - *b.slope_rad) <= kAsSteep_rad;
}

void TakeUp(const Terrain& terrain, double length, TerrainSection& section) {
  const double before = section.end - section.begin;
  section.terrain.shake = std::max(section.terrain.shake, terrain.shake);
  section.terrain.vertical_mps2 = std::max(section.terrain.vertical_mps2, terrain.vertical_mps2);
  if (terrain.slope_rad && before + length > 0.0) {
    *section.terrain.slope_rad +=
        (*terrain.slope_rad - *section.terrain.slope_rad) * length / (before + length);
  }
  section.end += length;
}

}  // namespace

void TerrainProfile::Add(const Segment& segment) {
  const double length = segment.extent();
  const double begin = sections_.empty() ? 0.0 : sections_.back().end;
  if (!sections_.empty() && Alike(sections_.back().terrain, segment.terrain)) {
    TakeUp(segment.terrain, length, sections_.back());
  } else {
    sections_.push_back({begin, begin + length, segment.index, segment.terrain});
  }
}

std::string SlopeText(double slope_rad) {
  return fmt::format("{:.1f} degrees {}", Degrees(std::abs(slope_rad)),
                     slope_rad >= 0.0 ? "uphill" : "downhill");
}

std::string RoughnessText(const Terrain& terrain) {
  const auto roughness = RoughnessOf(terrain);
  if (!roughness) return "not known";
  return terrain.vertical_mps2
             ? fmt::format("{} ({:.2f} m/s2)", NameOf(*roughness), *terrain.vertical_mps2)
             : fmt::format("{} (shakes by {:.2f} % of the picture)", NameOf(*roughness),
                           100.0 * *terrain.shake);
}

std::string TerrainText(const Terrain& terrain) {
  if (!terrain.slope_rad) return RoughnessText(terrain);
  if (!RoughnessOf(terrain)) return SlopeText(*terrain.slope_rad);
  return RoughnessText(terrain) + ", " + SlopeText(*terrain.slope_rad);
}

}  // namespace trailcast::route
