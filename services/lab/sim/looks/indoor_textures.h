#pragma once

#include <cstdint>

#include "services/image/canvas.h"
#include "services/lab/sim/core/texture.h"

namespace trailcast::sim {

// These functions draw pictures of things in a laboratory; the same arguments give the same
// picture.

// Surfaces repeat. `tint` is their mean colour.
[[nodiscard]] TexturePtr WoodGrain(image::Color tint, std::uint64_t seed);    // 1 m x 1 m
[[nodiscard]] TexturePtr FloorBoards(std::uint64_t seed);                     // 2.4 m x 2.4 m
[[nodiscard]] TexturePtr CarpetTiles(image::Color tint, std::uint64_t seed);  // 1 m x 1 m
[[nodiscard]] TexturePtr Plaster(image::Color tint, std::uint64_t seed);      // 3 m x 3 m
[[nodiscard]] TexturePtr Brickwork(std::uint64_t seed);                       // 1.5 m x 1.5 m
[[nodiscard]] TexturePtr CeilingTiles(std::uint64_t seed);                    // 1.2 m x 1.2 m
[[nodiscard]] TexturePtr Fabric(image::Color tint, std::uint64_t seed);       // 0.5 m x 0.5 m

// Things are seen from the front.
[[nodiscard]] TexturePtr Poster(std::uint64_t seed);
[[nodiscard]] TexturePtr Screen(std::uint64_t seed);
[[nodiscard]] TexturePtr Keyboard();
// There are 16 spines side by side, each a sixteenth of the width.
inline constexpr int kSpines = 16;
[[nodiscard]] TexturePtr BookSpines(std::uint64_t seed);
[[nodiscard]] TexturePtr Binders(std::uint64_t seed);  // likewise 16 of them
[[nodiscard]] TexturePtr Carton(std::uint64_t seed);
[[nodiscard]] TexturePtr Whiteboard(std::uint64_t seed);
[[nodiscard]] TexturePtr DoorLeaf(const char* sign);
[[nodiscard]] TexturePtr CupboardDoors(const char* label);
[[nodiscard]] TexturePtr Instrument(std::uint64_t seed);
[[nodiscard]] TexturePtr WindowView(std::uint64_t seed);
[[nodiscard]] TexturePtr PrintedPage(std::uint64_t seed);

}  // namespace trailcast::sim
