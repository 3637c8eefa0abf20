#include "services/belief/moved_grid.h"

#include <algorithm>
#include <cmath>

namespace trailcast::belief {

std::size_t MovedGrid::CellOf(double along) const {
  const double cell = std::floor((along - offset_) / cell_);
  return static_cast<std::size_t>(std::clamp(cell, 0.0, static_cast<double>(cells_.size()) - 1.0));
}

void MovedGrid::Shift(double along) {
  offset_ += along;
  const double cells = std::floor(offset_ / cell_);
  if (cells == 0.0) return;
  cells_.Move({static_cast<std::ptrdiff_t>(cells), {1.0}});
  offset_ -= cells * cell_;
}

void MovedGrid::Spread(double variance) {
  constexpr double kWorthWhile = 0.1;  // of a cell squared
  constexpr double kMostAStep = 0.25;
  variance_due_ += variance / (cell_ * cell_);
  if (variance_due_ < kWorthWhile) return;
  while (variance_due_ > 0.0) {
    const double aside = std::min(kMostAStep, 0.5 * variance_due_);
    cells_.Move({-1, {aside, 1.0 - 2.0 * aside, aside}});
    variance_due_ -= 2.0 * aside;
  }
  variance_due_ = 0.0;
}

}  // namespace trailcast::belief
