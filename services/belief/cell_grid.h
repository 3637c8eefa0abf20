#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace trailcast::belief {

// A probability mass for each cell of a line, at a cost that does not grow with the line: only
// blocks of cells with a mass worth telling apart are kept cell by cell, the rest of the mass lies
// evenly over all the other cells. Exact but for that.
class CellGrid {
 public:
  // A move: by `first` cells with the first of these probabilities, one more with the second, ...
  struct Taps {
    std::ptrdiff_t first = 0;
    std::vector<double> weights;

    // Adds the weight for a move by so many cells, a share of it to either neighbour.
    void Add(double cells, double weight);
  };

  // New cells at the end; they take part in what lies evenly.
  void Grow(std::size_t cells);
  [[nodiscard]] std::size_t size() const { return cells_.size(); }
  [[nodiscard]] double at(std::size_t cell) const {
    return active_[cell / kBlock] != 0 ? cells_[cell] : even_;
  }

  // All mass evenly.
  void Reset(double mass);
  void Set(std::size_t cell, double mass);
  // Each of the cells from `first` on.
  void Multiply(std::size_t first, std::span<const double> factors);
  void Scale(double factor);
  void AddEvenly(double mass);
  // What would leave the line stays at its end.
  void Move(const Taps& taps);
  // So much of each cell's mass in another grid of as many cells.
  void Add(const CellGrid& other, double factor);
  // Blocks of no more than this mass lose their features.
  void Forget(double negligible);

  [[nodiscard]] double Sum() const;
  // The cell with the most of those that are told apart; 0 where none is.
  [[nodiscard]] std::size_t Peak() const;

 private:
  static constexpr std::size_t kBlock = 64;

  [[nodiscard]] std::size_t blocks() const { return active_.size(); }
  [[nodiscard]] std::pair<std::size_t, std::size_t> CellsOf(std::size_t block) const;
  [[nodiscard]] double MassOf(std::size_t block) const;
  [[nodiscard]] std::size_t even_cells() const { return cells_.size() - active_cells_; }
  void Activate(std::size_t block);
  void ActivateAround(std::size_t reach);
  // The next run of active blocks from `block` on, as cells; an empty one: there is none.
  [[nodiscard]] std::pair<std::size_t, std::size_t> RunFrom(std::size_t block) const;
  template <typename Function>
  void ForEachRun(Function function) const;

  std::vector<double> cells_;  // of active blocks; the others' are of no interest
  std::vector<char> active_;   // by block
  std::size_t active_cells_ = 0;
  double even_ = 0.0;  // of each cell that is not active
  std::vector<double> scratch_;
};

}  // namespace trailcast::belief
