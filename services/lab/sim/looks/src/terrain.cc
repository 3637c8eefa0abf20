#include "services/lab/sim/looks/terrain.h"

#include <algorithm>
#include <cmath>

#include "services/lab/sim/core/angles.h"

namespace trailcast::sim {
namespace {

std::vector<float> Places(const GridLines& lines) {
  constexpr float kGrowth = 1.25F;
  std::vector<float> below;
  float step = lines.cell_m * kGrowth;
  for (float at = lines.fine_from - step; at > lines.low_limit; at -= step) {
    below.push_back(at);
    step *= kGrowth;
  }
  std::vector<float> places;
  if (lines.low_limit < lines.fine_from) places.push_back(lines.low_limit);
  places.insert(places.end(), below.rbegin(), below.rend());
  const int cells =
      std::max(1, static_cast<int>(std::lround((lines.fine_to - lines.fine_from) / lines.cell_m)));
  for (int i = 0; i <= cells; ++i) {
    const float share = static_cast<float>(i) / static_cast<float>(cells);
    places.push_back(lines.fine_from + share * (lines.fine_to - lines.fine_from));
  }
  step = lines.cell_m * kGrowth;
  for (float at = lines.fine_to + step; at < lines.high_limit; at += step) {
    places.push_back(at);
    step *= kGrowth;
  }
  if (lines.high_limit > lines.fine_to) places.push_back(lines.high_limit);
  return places;
}

}  // namespace

Terrain::Terrain(const std::vector<Wave>& waves, std::uint64_t seed) {
  constexpr int kDirections = 7;
  Random random(seed, "terrain");
  for (const Wave& wave : waves) {
    for (int i = 0; i < kDirections; ++i) {
      const auto angle = static_cast<float>(random.Uniform(0.0, kFullTurn));
      const float length_m = wave.length_m * static_cast<float>(random.Uniform(0.7, 1.4));
      const float k = kFullTurn / length_m;
      ripples_.push_back({k * std::cos(angle), k * std::sin(angle),
                          static_cast<float>(random.Uniform(0.0, kFullTurn)),
                          wave.amplitude_m * std::sqrt(2.0F / kDirections)});
    }
  }
}

float Terrain::Height(float x, float y) const {
  float height_m = 0.0F;
  for (const Ripple& ripple : ripples_) {
    height_m += ripple.amplitude_m * std::sin(ripple.kx * x + ripple.ky * y + ripple.phase);
  }
  return height_m;
}

void AddHeightField(SceneBuilder& builder, MaterialId material, const GridLines& x,
                    const GridLines& y, float tile_m,
                    const std::function<float(float, float)>& height) {
  const std::vector<float> columns = Places(x);
  const std::vector<float> rows = Places(y);
  const auto width = static_cast<std::uint32_t>(columns.size());
  Mesh piece;
  for (const float row : rows) {
    for (const float column : columns) {
      piece.positions.emplace_back(column, row, height(column, row));
      piece.uvs.emplace_back(column / tile_m, -row / tile_m);
    }
  }
  for (std::uint32_t row = 0; row + 1 < rows.size(); ++row) {
    for (std::uint32_t column = 0; column + 1 < width; ++column) {
      const std::uint32_t a = row * width + column;
      piece.triangles.push_back({a, a + 1, a + width + 1});
      piece.triangles.push_back({a, a + width + 1, a + width});
    }
  }
  builder.Add(material, piece);
}

void AddBoulder(SceneBuilder& builder, MaterialId material, float radius_m, Random& random) {
  constexpr std::uint32_t kRows = 3;
  constexpr std::uint32_t kColumns = 7;
  constexpr float kTile_m = 0.5F;
  const auto stretch = static_cast<float>(random.Uniform(0.7, 1.4));
  Mesh piece;
  for (std::uint32_t row = 0; row <= kRows; ++row) {
    const float tilt = 0.3F * kFullTurn * static_cast<float>(row) / kRows;
    for (std::uint32_t column = 0; column < kColumns; ++column) {
      const float angle = kFullTurn * static_cast<float>(column) / kColumns;
      const float reach =
          radius_m * (row == 0 ? 0.9F : static_cast<float>(random.Uniform(0.8, 1.1)));
      piece.positions.emplace_back(stretch * reach * std::sin(tilt) * std::cos(angle),
                                   reach * std::sin(tilt) * std::sin(angle),
                                   0.7F * reach * std::cos(tilt));
      piece.uvs.emplace_back(radius_m * angle / kTile_m, radius_m * tilt / kTile_m);
      if (row == kRows) continue;
      const std::uint32_t a = row * kColumns + column;
      const std::uint32_t next = row * kColumns + (column + 1) % kColumns;
      piece.triangles.push_back({a, a + kColumns, next + kColumns});
      piece.triangles.push_back({a, next + kColumns, next});
    }
  }
  builder.Add(material, piece);
}

}  // namespace trailcast::sim
