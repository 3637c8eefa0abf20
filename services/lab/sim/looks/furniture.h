#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "services/lab/sim/core/random.h"
#include "services/lab/sim/core/scene_builder.h"

namespace trailcast::sim {

// Builds the furniture of a laboratory or an office out of boxes, cylinders and panels. Each piece
// stands in the builder's current place: x to its right, y to its back, z up, front at y = 0.
class Furniture {
 public:
  // Keeps a reference to `builder`. The same seed gives the same things on the same shelves.
  Furniture(SceneBuilder& builder, std::uint64_t seed);

  // Puts the piece's left front corner on the floor at (x, y), as seen by a person in front of it
  // who looks along `yaw_rad` + 90 degrees.
  void Stand(float x, float y, float yaw_rad, float z = 0.0F);
  // Does the same for parts of the building, which nobody moves.
  void Build(float x, float y, float yaw_rad, float z = 0.0F);
  // From here on, this share of the furniture was moved, by 0.3 to 0.6 m to its right or left. With
  // one seed, a larger share also moves everything that a smaller one does.
  void MoveSome(double share, std::uint64_t seed);

  void Desk(float width, float depth);
  void DeskThings(float width, float depth);  // on a desk of that size: screens, keyboard, papers
  void LabBench(float width, float depth);    // with instruments
  void Chair();                               // its middle at the origin
  void Shelf(float width, float height, float depth, int boards);
  void Cupboard(float width, float height, float depth);
  void RoundTable();  // its middle at the origin
  void Plant();       // its middle at the origin
  void Bin();         // its middle at the origin
  void Cartons(int count);
  // These hang on a wall: the lower left corner is at the origin, and the front faces -y.
  void Hang(MaterialId picture, float width, float height, float thickness = 0.02F);
  void Window(float width, float height);
  void Door(MaterialId leaf);
  void Radiator(float width);

  [[nodiscard]] MaterialId poster() { return posters_[next_poster_++ % posters_.size()]; }
  [[nodiscard]] MaterialId whiteboard() const { return whiteboard_; }
  [[nodiscard]] MaterialId page() const { return page_; }
  [[nodiscard]] MaterialId metal() const { return metal_; }

 private:
  void Monitor(float x, float y);
  void RowOfSpines(float width, float depth, float z, float room_m);
  void RowOfCartons(float width, float depth, float z, float room_m);

  SceneBuilder& b_;
  Random random_;
  Random moves_;
  double moved_share_ = 0.0;
  MaterialId wood_, light_wood_, metal_, dark_, white_, seat_, paper_, page_, keyboard_;
  MaterialId whiteboard_, cupboard_, leaf_, pot_, view_, red_, blue_;
  std::vector<MaterialId> posters_, screens_, spines_, cartons_, instruments_;
  std::size_t next_poster_ = 0;
};

}  // namespace trailcast::sim
