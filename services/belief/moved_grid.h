#pragma once

#include <cstddef>

#include "services/belief/cell_grid.h"

namespace trailcast::belief {

// A CellGrid along a route whose mass moves by any distance: what is less than a cell is kept as an
// offset of all cells. Places and distances are in the route's units.
class MovedGrid {
 public:
  explicit MovedGrid(double cell) : cell_(cell) {}

  [[nodiscard]] double cell() const { return cell_; }  // a cell's length
  [[nodiscard]] CellGrid& cells() { return cells_; }
  [[nodiscard]] const CellGrid& cells() const { return cells_; }
  // The cell that a place is in; the nearest one for a place outside.
  [[nodiscard]] std::size_t CellOf(double along) const;
  // A cell's middle.
  [[nodiscard]] double PlaceOf(std::size_t cell) const {
    return (static_cast<double>(cell) + 0.5) * cell_ + offset_;
  }

  // All mass moves so far.
  void Shift(double along);
  // A random walk of that variance, as steps to the neighbouring cells.
  void Spread(double variance);
  // Mass moves by several distances, each with its share.
  void Scatter(const CellGrid::Taps& taps) { cells_.Move(taps); }

 private:
  double cell_;
  CellGrid cells_;
  double offset_ = 0.0;
  double variance_due_ = 0.0;  // of spreading, until it is worth while
};

}  // namespace trailcast::belief
