#include "services/lab/sim/looks/vehicle_shape.h"

#include <cstddef>

namespace trailcast::sim {
namespace {

constexpr VehicleSizes kSaloon = {.sections = {{{-2.22F, 0.34F, 0.60F, 0.76F},
                                                {-2.14F, 0.22F, 0.72F, 0.84F},
                                                {-1.15F, 0.20F, 0.92F, 0.88F},
                                                {0.20F, 0.19F, 0.95F, 0.89F},
                                                {1.45F, 0.20F, 0.98F, 0.88F},
                                                {2.14F, 0.24F, 0.95F, 0.83F},
                                                {2.22F, 0.36F, 0.80F, 0.78F}}},
                                  .cabin_foot = {-1.18F, 1.62F, 0.92F, 0.80F},
                                  .roof = {-0.36F, 0.98F, 1.43F, 0.58F},
                                  .front_doors_end = 0.50F,
                                  .front_axle = -1.36F,
                                  .rear_axle = 1.34F,
                                  .wheel_radius = 0.32F,
                                  .rear_side_windows = true};
constexpr VehicleSizes kHatchback = {.sections = {{{-1.92F, 0.34F, 0.62F, 0.74F},
                                                   {-1.84F, 0.21F, 0.76F, 0.81F},
                                                   {-0.98F, 0.19F, 0.96F, 0.85F},
                                                   {0.30F, 0.18F, 1.00F, 0.86F},
                                                   {1.50F, 0.20F, 1.02F, 0.84F},
                                                   {1.90F, 0.26F, 0.98F, 0.80F},
                                                   {1.96F, 0.36F, 0.80F, 0.76F}}},
                                     .cabin_foot = {-1.04F, 1.88F, 0.96F, 0.78F},
                                     .roof = {-0.26F, 1.50F, 1.50F, 0.58F},
                                     .front_doors_end = 0.55F,
                                     .front_axle = -1.20F,
                                     .rear_axle = 1.24F,
                                     .wheel_radius = 0.30F,
                                     .rear_side_windows = true};
constexpr VehicleSizes kEstate = {.sections = {{{-2.24F, 0.34F, 0.62F, 0.77F},
                                                {-2.16F, 0.22F, 0.74F, 0.85F},
                                                {-1.20F, 0.20F, 0.94F, 0.89F},
                                                {0.20F, 0.19F, 0.97F, 0.90F},
                                                {1.70F, 0.20F, 1.00F, 0.89F},
                                                {2.22F, 0.24F, 0.97F, 0.85F},
                                                {2.28F, 0.36F, 0.80F, 0.80F}}},
                                  .cabin_foot = {-1.22F, 2.18F, 0.94F, 0.81F},
                                  .roof = {-0.40F, 1.86F, 1.48F, 0.61F},
                                  .front_doors_end = 0.46F,
                                  .front_axle = -1.38F,
                                  .rear_axle = 1.36F,
                                  .wheel_radius = 0.32F,
                                  .rear_side_windows = true};
constexpr VehicleSizes kVan = {.sections = {{{-2.52F, 0.38F, 0.66F, 0.84F},
                                             {-2.42F, 0.26F, 0.98F, 0.94F},
                                             {-1.78F, 0.24F, 1.16F, 0.97F},
                                             {0.00F, 0.24F, 1.22F, 0.98F},
                                             {2.30F, 0.24F, 1.22F, 0.98F},
                                             {2.50F, 0.30F, 1.20F, 0.96F},
                                             {2.54F, 0.44F, 1.00F, 0.94F}}},
                               .cabin_foot = {-1.98F, 2.50F, 1.14F, 0.95F},
                               .roof = {-1.30F, 2.42F, 2.22F, 0.86F},
                               .front_doors_end = 0.30F,
                               .front_axle = -1.68F,
                               .rear_axle = 1.60F,
                               .wheel_radius = 0.35F,
                               .rear_side_windows = false};

}  // namespace

const VehicleSizes& SizesOf(VehicleShape shape) {
  static constexpr std::array kAll = {kSaloon, kHatchback, kEstate, kVan};
  return kAll[static_cast<std::size_t>(shape)];
}

}  // namespace trailcast::sim
