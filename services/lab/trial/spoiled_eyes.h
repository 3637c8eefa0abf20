#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "services/base/result.h"
#include "services/image/image.h"

namespace trailcast::trial {

// What is wrong with a follower that neither it nor anybody knows of: visits that a route must not
// suffer from.
enum class Spoiled : std::uint8_t {
  kNothing,
  kMirror,  // its pictures are mirrored
  kDirt,    // a third of its lens is covered by spots, which have an outline and a grain
  kAside,   // it is put down 0.6 m beside the route's start
};
[[nodiscard]] const std::vector<std::string>& SpoiledNames();
// kNotFound lists the names there are; an empty one is nothing.
[[nodiscard]] Result<Spoiled> FindSpoiled(const std::string& name);

// What becomes of a picture; of one seed the same spots.
void Spoil(Spoiled what, std::uint64_t seed, image::GrayImage& picture);

}  // namespace trailcast::trial
