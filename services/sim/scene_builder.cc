#include "services/sim/scene_builder.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace trailcast::sim {
namespace {

// Fine enough for soft shadows under desks, coarse enough to bake quickly.
constexpr float kCell_m = 0.3F;

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

void SceneBuilder::Panel(MaterialId material, const Eigen::Vector3f& upper_left,
                         const Eigen::Vector3f& right, const Eigen::Vector3f& down,
                         const TexturePart& part) {
  Mesh& mesh = MeshOf(material);
  const int columns = std::max(1, static_cast<int>(std::ceil(right.norm() / kCell_m)));
  const int rows = std::max(1, static_cast<int>(std::ceil(down.norm() / kCell_m)));
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

Scene SceneBuilder::Take(const std::string& name) {
  scene_.name = name;
  return std::exchange(scene_, {});
}

}  // namespace trailcast::sim
