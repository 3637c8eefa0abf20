#pragma once

#include <cstddef>

#include "services/belief/cell_grid.h"

namespace trailcast::belief {

// This is a CellGrid along a route whose mass moves by any distance: an offset of all cells keeps
// what is less than a cell. Places and distances are in the route's units.
class MovedGrid {
 public:
  explicit MovedGrid(double cell) : cell_(cell) {}

  [[nodiscard]] double cell() const { return cell_; }  // a cell's length
  [[nodiscard]] CellGrid& cells() { return cells_; }
  [[nodiscard]] const CellGrid& cells() const { return cells_; }
  // Returns the cell that a place is in, or the nearest one for a place outside.
  [[nodiscard]] std::size_t CellOf(double along) const;
  // Returns the middle of a cell.
  [[nodiscard]] double PlaceOf(std::size_t cell) const {
    return (static_cast<double>(cell) + 0.5) * cell_ + offset_;
  }

  // Moves all mass by this distance.
  void Shift(double along);
  // Spreads the mass like a random walk of that variance, by steps to the neighbouring cells.
  void Spread(double variance);
  // Moves shares of the mass by several distances.
  void Scatter(const CellGrid::Taps& taps) { cells_.Move(taps); }

 private:
  double cell_;
  CellGrid cells_;
  double offset_ = 0.0;
  double variance_due_ = 0.0;  // spreading that is put off until it is worth while
};

}  // namespace trailcast::belief
