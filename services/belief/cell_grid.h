#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace trailcast::belief {

// This holds a probability mass for each cell of a line, at a cost that does not grow with the
// line. Only blocks of cells with a significant mass are kept cell by cell; the rest of the mass
// lies evenly over all other cells. Apart from that it is exact.
class CellGrid {
 public:
  // This is a move by `first` cells with the first of these probabilities, by one more with the
  // second, and so on.
  struct Taps {
    std::ptrdiff_t first = 0;
    std::vector<double> weights;

    // Adds the weight of a move by so many cells, shared between the two nearest whole numbers.
    void Add(double cells, double weight);
  };

  // Adds cells at the end, which take part in the even mass.
  void Grow(std::size_t cells);
  [[nodiscard]] std::size_t size() const { return cells_.size(); }
  [[nodiscard]] double at(std::size_t cell) const {
    return active_[cell / kBlock] != 0 ? cells_[cell] : even_;
  }

  // Spreads all mass evenly.
  void Reset(double mass);
  void Set(std::size_t cell, double mass);
  // Multiplies the cells from `first` on, each by its factor.
  void Multiply(std::size_t first, std::span<const double> factors);
  void Scale(double factor);
  void AddEvenly(double mass);
  // Mass that would leave the line stays at its end.
  void Move(const Taps& taps);
  // Adds another grid of as many cells, times `factor`.
  void Add(const CellGrid& other, double factor);
  // Blocks of no more than this mass become even.
  void Forget(double negligible);

  [[nodiscard]] double Sum() const;
  // Returns the cell with the most mass of those in active blocks, or 0 if there are none.
  [[nodiscard]] std::size_t Peak() const;

 private:
  static constexpr std::size_t kBlock = 64;

  [[nodiscard]] std::size_t blocks() const { return active_.size(); }
  [[nodiscard]] std::pair<std::size_t, std::size_t> CellsOf(std::size_t block) const;
  [[nodiscard]] double MassOf(std::size_t block) const;
  [[nodiscard]] std::size_t even_cells() const { return cells_.size() - active_cells_; }
  void Activate(std::size_t block);
  void ActivateAround(std::size_t reach);
  // Returns the next run of active blocks from `block` on, as cells, or an empty one if there is
  // none.
  [[nodiscard]] std::pair<std::size_t, std::size_t> RunFrom(std::size_t block) const;
  template <typename Function>
  void ForEachRun(Function function) const;

  std::vector<double> cells_;  // valid in active blocks only
  std::vector<char> active_;   // by block
  std::size_t active_cells_ = 0;
  double even_ = 0.0;  // mass of each cell that is not active
  std::vector<double> scratch_;
};

}  // namespace trailcast::belief
