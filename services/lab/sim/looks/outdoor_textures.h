#pragma once

#include <cstdint>

#include "services/image/canvas.h"
#include "services/lab/sim/core/texture.h"

namespace trailcast::sim {

// These functions draw pictures of things out of doors; the same arguments give the same picture.

// Ground, walls and plants repeat. `tint` is their mean colour.
[[nodiscard]] TexturePtr Asphalt(image::Color tint, std::uint64_t seed);   // 4 m x 4 m
[[nodiscard]] TexturePtr Concrete(image::Color tint, std::uint64_t seed);  // 3 m x 3 m
[[nodiscard]] TexturePtr Slabs(std::uint64_t seed);                        // 2 m x 2 m
[[nodiscard]] TexturePtr Lawn(std::uint64_t seed);                         // 2.5 m x 2.5 m
[[nodiscard]] TexturePtr Turf(std::uint64_t seed);                         // 5 m x 5 m, mown short
[[nodiscard]] TexturePtr Meadow(std::uint64_t seed);  // 3 m x 3 m, with bare earth
[[nodiscard]] TexturePtr RoofTiles(image::Color tint, std::uint64_t seed);  // 2 m x 2 m
[[nodiscard]] TexturePtr Planks(image::Color tint, std::uint64_t seed);     // 1.2 m, upright
[[nodiscard]] TexturePtr Bark(std::uint64_t seed);                          // once round a trunk
[[nodiscard]] TexturePtr Foliage(image::Color tint, std::uint64_t seed);    // about 0.8 m
[[nodiscard]] TexturePtr WornPaint(std::uint64_t seed);  // 2 m x 2 m of road marking
[[nodiscard]] TexturePtr Stone(std::uint64_t seed);      // about 0.5 m

// Things are seen from the front.
[[nodiscard]] TexturePtr HouseWindow(std::uint64_t seed);  // 2 wide, 3 high
[[nodiscard]] TexturePtr ShopWindow(std::uint64_t seed);   // 2 wide, 1 high
[[nodiscard]] TexturePtr HouseDoor(image::Color tint, const char* number);
[[nodiscard]] TexturePtr GarageDoor(image::Color tint);
[[nodiscard]] TexturePtr ShopSign(std::uint64_t seed);  // 6 wide, 1 high
[[nodiscard]] TexturePtr ParkingSign(const char* line);
[[nodiscard]] TexturePtr RoundSign(const char* text);
[[nodiscard]] TexturePtr NumberPlate(std::uint64_t seed);
[[nodiscard]] TexturePtr ManholeCover();
// From the roof line (top) to the sill (bottom) it shows the sky's reflection, then the ground's.
[[nodiscard]] TexturePtr CarPaint(image::Color tint, std::uint64_t seed);
[[nodiscard]] TexturePtr CarGlass(std::uint64_t seed);
[[nodiscard]] TexturePtr CarFront(image::Color tint, std::uint64_t seed);  // grille and lamps
[[nodiscard]] TexturePtr CarRear(image::Color tint, std::uint64_t seed);
[[nodiscard]] TexturePtr Wheel();

}  // namespace trailcast::sim
