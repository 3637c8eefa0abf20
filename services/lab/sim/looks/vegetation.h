#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "services/lab/sim/core/random.h"
#include "services/lab/sim/core/scene_builder.h"

namespace trailcast::sim {

// Grows plants out of clusters of leaves (flat, ragged, textured) round dark cores. Each stands in
// the builder's current place on z = 0, with its middle at the origin unless said otherwise.
class Vegetation {
 public:
  // The number of clusters to a square metre, and their size; near plants need small ones.
  struct Detail {
    float clusters_per_m2;
    float cluster_m;
  };
  static constexpr Detail kNear = {16.0F, 0.24F};
  static constexpr Detail kAcross = {5.0F, 0.44F};  // 10 m away and more
  static constexpr Detail kFar = {0.5F, 1.3F};      // 40 m away and more

  // Keeps a reference to `builder`. The same seed grows the same plants.
  Vegetation(SceneBuilder& builder, std::uint64_t seed);

  void Stand(float x, float y, float z = 0.0F);  // turned any way

  void Tree(float height_m, float crown_radius_m, const Detail& detail = kAcross);
  void Conifer(float height_m, float radius_m, const Detail& detail = kAcross);
  void Bush(float radius_m, float height_m, const Detail& detail = kNear);
  // A hedge is between two places, on z = 0 of the world.
  void Hedge(const Eigen::Vector2f& from, const Eigen::Vector2f& to, float height_m, float depth_m,
             const Detail& detail = kNear);
  void Tussock(float radius_m, float height_m);

 private:
  struct Ball {
    Eigen::Vector3f middle;
    Eigen::Vector3f radii;
  };
  void LeafBall(const Ball& ball, const Detail& detail, std::size_t kind);
  void Core(const Ball& ball, std::size_t kind);
  void Cluster(const Eigen::Vector3f& middle, const Eigen::Vector3f& normal, float size_m,
               float shade, Mesh& piece);
  void Trunk(float height_m, float radius_m);
  [[nodiscard]] float Between(float low, float high);
  [[nodiscard]] Eigen::Vector3f AnyDirection();
  [[nodiscard]] std::size_t AnyKind();

  SceneBuilder& b_;
  Random random_;
  std::vector<MaterialId> leaves_;
  MaterialId bark_, needles_, hedge_, blades_;
};

}  // namespace trailcast::sim
