#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "services/base/result.h"
#include "services/image/image.h"

namespace trailcast::trial {

// A fault of a follower that neither it nor anybody knows of. Routes must not suffer from such
// visits.
enum class Spoiled : std::uint8_t {
  kNothing,
  kMirror,  // its pictures are mirrored
  kDirt,    // spots cover a third of its lens, with an outline and a grain
  kAside,   // it is put down 0.6 m beside the route's start
};
[[nodiscard]] const std::vector<std::string>& SpoiledNames();
// kNotFound lists the existing names; an empty one stands for no fault.
[[nodiscard]] Result<Spoiled> FindSpoiled(const std::string& name);

// Applies the fault to a picture; one seed gives the same spots.
void Spoil(Spoiled what, std::uint64_t seed, image::GrayImage& picture);

}  // namespace trailcast::trial
