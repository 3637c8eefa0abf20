#include "services/lab/sim/core/scene_builder.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace trailcast::sim {
namespace {

// Gives the point of a circle round `axis` at a share of the full turn.
struct Rim {
  Rim(const Eigen::Vector3f& axis, float radius_m)
      : side(radius_m * axis.unitOrthogonal()), other(axis.normalized().cross(side)) {}
  [[nodiscard]] Eigen::Vector3f At(float share) const {
    const float angle = 2.0F * std::numbers::pi_v<float> * share;
    return std::cos(angle) * side + std::sin(angle) * other;
  }
  Eigen::Vector3f side, other;
};

}  // namespace

MaterialId SceneBuilder::AddMaterial(const std::string& name, const Eigen::Vector3f& color,
                                     std::shared_ptr<const Texture> texture, bool glows) {
  scene_.materials.push_back({name, color, std::move(texture), glows});
  Mesh mesh;
  mesh.material = scene_.materials.size() - 1;
  scene_.meshes.push_back(std::move(mesh));
  return {scene_.materials.size() - 1};
}

Mesh& SceneBuilder::MeshOf(MaterialId material) { return scene_.meshes[material.index]; }

void SceneBuilder::Place(const Eigen::Vector3f& origin, float yaw_rad) {
  place_ = Eigen::Translation3f(origin) * Eigen::AngleAxisf(yaw_rad, Eigen::Vector3f::UnitZ());
}

void SceneBuilder::PlaceIn(const Eigen::Isometry3f& frame, const Eigen::Vector3f& origin,
                           float yaw_rad) {
  Place(origin, yaw_rad);
  place_ = frame * place_;
}

void SceneBuilder::Panel(MaterialId material, const Eigen::Vector3f& upper_left,
                         const Eigen::Vector3f& right, const Eigen::Vector3f& down,
                         const TexturePart& part) {
  Mesh& mesh = MeshOf(material);
  const int columns = std::max(1, static_cast<int>(std::ceil(right.norm() / cell_m_)));
  const int rows = std::max(1, static_cast<int>(std::ceil(down.norm() / cell_m_)));
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  const Eigen::Vector2f size = part.lower_right - part.upper_left;
  for (int row = 0; row <= rows; ++row) {
    for (int column = 0; column <= columns; ++column) {
      const Eigen::Vector2f share(static_cast<float>(column) / static_cast<float>(columns),
                                  static_cast<float>(row) / static_cast<float>(rows));
      mesh.positions.push_back(place_ * (upper_left + share.x() * right + share.y() * down));
      mesh.uvs.push_back(part.upper_left + size.cwiseProduct(share));
    }
  }
  const auto at = [&](int row, int column) {
    return first + static_cast<std::uint32_t>(image::PixelIndex(column, row, columns + 1));
  };
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const auto a = at(row, column);
      const auto b = at(row + 1, column);
      const auto c = at(row + 1, column + 1);
      const auto d = at(row, column + 1);
      mesh.triangles.push_back({a, b, c});
      mesh.triangles.push_back({a, c, d});
    }
  }
}

void SceneBuilder::Facing(MaterialId material, const Eigen::Vector3f& upper_left,
                          const Eigen::Vector3f& right, const Eigen::Vector3f& down, float tile_m) {
  Panel(material, upper_left, right, down,
        {{0.0F, 0.0F}, {right.norm() / tile_m, down.norm() / tile_m}});
}

void SceneBuilder::Box(MaterialId material, const Eigen::Vector3f& low, const Eigen::Vector3f& high,
                       float tile_m) {
  const Eigen::Vector3f size = high - low;
  const Eigen::Vector3f x(size.x(), 0.0F, 0.0F);
  const Eigen::Vector3f y(0.0F, size.y(), 0.0F);
  const Eigen::Vector3f z(0.0F, 0.0F, size.z());
  Facing(material, low + z, x, -z, tile_m);           // front
  Facing(material, low + x + y + z, -x, -z, tile_m);  // back
  Facing(material, low + y + z, -y, -z, tile_m);      // left
  Facing(material, low + x + z, y, -z, tile_m);       // right
  Facing(material, low + y + z, x, -y, tile_m);       // top
  Facing(material, low, x, y, tile_m);                // bottom
}

void SceneBuilder::Cylinder(MaterialId material, const Eigen::Vector3f& foot, float radius_m,
                            float height_m, float repeats, int sides) {
  const Eigen::Vector3f up(0.0F, 0.0F, height_m);
  const auto rim = [&](int i) -> Eigen::Vector3f {
    const float angle =
        2.0F * std::numbers::pi_v<float> * static_cast<float>(i) / static_cast<float>(sides);
    return foot + radius_m * Eigen::Vector3f(std::cos(angle), std::sin(angle), 0.0F);
  };
  for (int i = 0; i < sides; ++i) {
    const float u = repeats * static_cast<float>(i) / static_cast<float>(sides);
    const float next_u = repeats * static_cast<float>(i + 1) / static_cast<float>(sides);
    Panel(material, rim(i) + up, rim(i + 1) - rim(i), -up, {{u, 0.0F}, {next_u, 1.0F}});
    Mesh& mesh = MeshOf(material);
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (const Eigen::Vector3f& corner : {Eigen::Vector3f(foot), rim(i), rim(i + 1)}) {
      mesh.positions.push_back(place_ * (corner + up));
      mesh.uvs.emplace_back(0.5F, 0.5F);
    }
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
}

void SceneBuilder::Bar(MaterialId material, const Eigen::Vector3f& from, const Eigen::Vector3f& to,
                       float thickness_m) {
  const Eigen::Vector3f along = to - from;
  const Eigen::Vector3f side =
      std::abs(along.normalized().z()) > 0.9F
          ? Eigen::Vector3f(thickness_m, 0.0F, 0.0F)
          : Eigen::Vector3f(thickness_m * along.cross(Eigen::Vector3f::UnitZ()).normalized());
  const Eigen::Vector3f across = thickness_m * along.cross(side).normalized();
  const Eigen::Vector3f corner = from - 0.5F * (side + across);
  Panel(material, corner, side, along);
  Panel(material, corner + side, across, along);
  Panel(material, corner + side + across, -side, along);
  Panel(material, corner + across, -across, along);
}

void SceneBuilder::Quad(MaterialId material, const std::array<Eigen::Vector3f, 4>& corners,
                        const TexturePart& part) {
  Mesh piece;
  piece.positions.assign(corners.begin(), corners.end());
  piece.uvs = {part.upper_left,
               {part.upper_left.x(), part.lower_right.y()},
               part.lower_right,
               {part.lower_right.x(), part.upper_left.y()}};
  piece.triangles = {{0, 1, 2}, {0, 2, 3}};
  Add(material, piece);
}

void SceneBuilder::Tube(MaterialId material, const Eigen::Vector3f& from, const Eigen::Vector3f& to,
                        float radius_from_m, float radius_to_m, int sides, float tile_m) {
  const Eigen::Vector3f along = to - from;
  const Rim rim(along, 1.0F);
  const float repeats = along.norm() / tile_m;
  Mesh piece;
  for (int i = 0; i <= sides; ++i) {
    const float share = static_cast<float>(i) / static_cast<float>(sides);
    piece.positions.emplace_back(from + radius_from_m * rim.At(share));
    piece.positions.emplace_back(to + radius_to_m * rim.At(share));
    piece.uvs.emplace_back(share, repeats);
    piece.uvs.emplace_back(share, 0.0F);
    if (i == sides) break;
    const auto first = static_cast<std::uint32_t>(2 * i);
    piece.triangles.push_back({first, first + 2, first + 3});
    piece.triangles.push_back({first, first + 3, first + 1});
  }
  Add(material, piece);
}

void SceneBuilder::Disc(MaterialId material, const Eigen::Vector3f& middle,
                        const Eigen::Vector3f& axis, float radius_m, int sides) {
  const Rim rim(axis, radius_m);
  Mesh piece;
  piece.positions.push_back(middle);
  piece.uvs.emplace_back(0.5F, 0.5F);
  for (int i = 0; i < sides; ++i) {
    const float share = static_cast<float>(i) / static_cast<float>(sides);
    const float angle = 2.0F * std::numbers::pi_v<float> * share;
    piece.positions.emplace_back(middle + rim.At(share));
    piece.uvs.emplace_back(0.5F + 0.5F * std::cos(angle), 0.5F - 0.5F * std::sin(angle));
    piece.triangles.push_back(
        {0, static_cast<std::uint32_t>(1 + i), static_cast<std::uint32_t>(1 + (i + 1) % sides)});
  }
  Add(material, piece);
}

void SceneBuilder::Add(MaterialId material, const Mesh& piece) {
  Mesh& mesh = MeshOf(material);
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (const Eigen::Vector3f& position : piece.positions) {
    mesh.positions.push_back(place_ * position);
  }
  if (!piece.shade.empty()) mesh.shade.resize(first, 1.0F);
  mesh.shade.insert(mesh.shade.end(), piece.shade.begin(), piece.shade.end());
  mesh.uvs.insert(mesh.uvs.end(), piece.uvs.begin(), piece.uvs.end());
  for (const auto& [a, b, c] : piece.triangles) {
    mesh.triangles.push_back({first + a, first + b, first + c});
  }
}

Scene SceneBuilder::Take(const std::string& name) {
  // Pieces without shade of their own get all the ambient light.
  for (Mesh& mesh : scene_.meshes) {
    if (!mesh.shade.empty()) mesh.shade.resize(mesh.positions.size(), 1.0F);
  }
  scene_.name = name;
  return std::exchange(scene_, {});
}

}  // namespace trailcast::sim
