#pragma once

#include <array>

namespace trailcast::sim {

enum class VehicleShape { kSaloon, kHatchback, kEstate, kVan };

// The sizes of a vehicle in metres. y runs from the nose (low) to the tail, and z = 0 is the
// ground.
struct VehicleSizes {
  // A section across the body: its place along the body, its lowest and highest point, and half its
  // width.
  struct Section {
    float y, low, high, half_width;
  };
  // A level rectangle of the cabin.
  struct Outline {
    float from, to, z, half_width;
  };
  std::array<Section, 7> sections;
  Outline cabin_foot;
  Outline roof;
  float front_doors_end;  // as a share of the cabin's length
  float front_axle;
  float rear_axle;
  float wheel_radius;
  bool rear_side_windows;

  [[nodiscard]] float half_width() const { return sections[3].half_width; }
};

[[nodiscard]] const VehicleSizes& SizesOf(VehicleShape shape);

}  // namespace trailcast::sim
