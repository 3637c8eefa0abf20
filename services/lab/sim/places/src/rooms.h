#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "services/base/result.h"
#include "services/lab/sim/core/light_bake.h"
#include "services/lab/sim/core/scene_builder.h"
#include "services/lab/sim/looks/furniture.h"
#include "services/lab/sim/places/place.h"

namespace trailcast::sim {

// A wall as seen by a person in front of it, from its left end to the right.
struct WallLine {
  Eigen::Vector2f left_end = {0.0F, 0.0F};
  float yaw_rad = 0.0F;  // direction to the right
};

// The things that stand or hang along a wall.
enum class Fitting {
  kDoor,
  kPoster,
  kNotices,  // small sheets
  kWhiteboard,
  kWindow,
  kRadiator,
  kShelf,
  kCupboard,
  kPlant,
  kBin
};
struct FittingAt {
  float along_m;  // its left end
  Fitting what;
};

// Builds floors, walls, ceilings and lamps of offices. Heights are from the floor at z = 0.
class Rooms {
 public:
  enum class Look { kPatterned, kPlain };
  static constexpr float kHeight_m = 2.6F;
  static constexpr float kWallThickness_m = 0.05F;

  // Keeps references. The same seed gives the same surfaces.
  Rooms(SceneBuilder& builder, Furniture& furniture, std::uint64_t seed);

  // Adds a level rectangle from `corner` in the frame turned by `yaw_rad`, with its ceiling.
  void FloorAndCeiling(const Eigen::Vector2f& corner, float yaw_rad, const Eigen::Vector2f& size,
                       Look look, float z_m = 0.0F);
  // Adds a wall whose front is on that line, seen with `from` at the left and `to` at the right.
  WallLine Wall(const Eigen::Vector2f& from, const Eigen::Vector2f& to, Look look);
  // Adds the part of a wall above a passage.
  void Lintel(const Eigen::Vector2f& from, const Eigen::Vector2f& to);
  void CeilingLamp(const Eigen::Vector2f& middle, float yaw_rad);
  void Fit(const WallLine& wall, const std::vector<FittingAt>& fittings);

  [[nodiscard]] const std::vector<Lamp>& lamps() const { return lamps_; }

 private:
  void FitOne(Fitting what);

  SceneBuilder& b_;
  Furniture& furniture_;
  std::vector<Lamp> lamps_;
  std::vector<MaterialId> doors_;
  std::size_t next_door_ = 0;
  MaterialId carpet_, lino_, tiles_, white_, painted_, plain_wall_, skirting_, glow_, lamp_frame_;
};

// Returns the finished place: the scene with the lamps' light baked into it, and the path through
// it. See BakeLight for `ambient`.
[[nodiscard]] Result<Place> FinishIndoors(Scene scene, const std::vector<Lamp>& lamps,
                                          Polyline points, float ambient = 0.55F);

}  // namespace trailcast::sim
