#include "services/belief/cell_grid.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace trailcast::belief {

void CellGrid::Taps::Add(double cells, double weight) {
  const double whole = std::floor(cells);
  const auto at = static_cast<std::ptrdiff_t>(whole);
  if (weights.empty()) first = at;
  if (at < first) {
    weights.insert(weights.begin(), static_cast<std::size_t>(first - at), 0.0);
    first = at;
  }
  const auto position = static_cast<std::size_t>(at - first);
  if (weights.size() < position + 2) weights.resize(position + 2, 0.0);
  weights[position] += weight * (1.0 - (cells - whole));
  weights[position + 1] += weight * (cells - whole);
}

std::pair<std::size_t, std::size_t> CellGrid::CellsOf(std::size_t block) const {
  return {block * kBlock, std::min((block + 1) * kBlock, cells_.size())};
}

double CellGrid::MassOf(std::size_t block) const {
  const auto [first, last] = CellsOf(block);
  return std::accumulate(cells_.begin() + static_cast<std::ptrdiff_t>(first),
                         cells_.begin() + static_cast<std::ptrdiff_t>(last), 0.0);
}

std::pair<std::size_t, std::size_t> CellGrid::RunFrom(std::size_t block) const {
  while (block < blocks() && active_[block] == 0) ++block;
  if (block == blocks()) return {cells_.size(), cells_.size()};
  std::size_t end = block;
  while (end < blocks() && active_[end] != 0) ++end;
  return {block * kBlock, std::min(end * kBlock, cells_.size())};
}

template <typename Function>
void CellGrid::ForEachRun(Function function) const {
  for (std::size_t block = 0; block < blocks();) {
    const auto [first, last] = RunFrom(block);
    if (first == last) return;
    function(first, last);
    block = (last + kBlock - 1) / kBlock;
  }
}

void CellGrid::Grow(std::size_t cells) {
  const double even = even_ * static_cast<double>(even_cells());
  // The last block grows if it was not full.
  if (!active_.empty() && active_.back() != 0) {
    const std::size_t filled = std::min(blocks() * kBlock, cells_.size() + cells);
    active_cells_ += filled - cells_.size();
  }
  cells_.resize(cells_.size() + cells, 0.0);
  active_.resize((cells_.size() + kBlock - 1) / kBlock, 0);
  even_ = even_cells() > 0 ? even / static_cast<double>(even_cells()) : 0.0;
}

void CellGrid::Reset(double mass) {
  std::fill(active_.begin(), active_.end(), 0);
  active_cells_ = 0;
  even_ = mass / static_cast<double>(cells_.size());
}

void CellGrid::Activate(std::size_t block) {
  if (active_[block] != 0) return;
  const auto [first, last] = CellsOf(block);
  std::fill(cells_.begin() + static_cast<std::ptrdiff_t>(first),
            cells_.begin() + static_cast<std::ptrdiff_t>(last), even_);
  active_[block] = 1;
  active_cells_ += last - first;
}

void CellGrid::Set(std::size_t cell, double mass) {
  Activate(cell / kBlock);
  cells_[cell] = mass;
}

void CellGrid::Multiply(std::size_t first, std::span<const double> factors) {
  if (factors.empty()) return;
  for (std::size_t b = first / kBlock; b <= (first + factors.size() - 1) / kBlock; ++b) Activate(b);
  for (std::size_t i = 0; i < factors.size(); ++i) cells_[first + i] *= factors[i];
}

void CellGrid::Scale(double factor) {
  ForEachRun([&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) cells_[i] *= factor;
  });
  even_ *= factor;
}

void CellGrid::AddEvenly(double mass) {
  const double each = mass / static_cast<double>(cells_.size());
  ForEachRun([&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) cells_[i] += each;
  });
  even_ += each;
}

// Mass that moves on comes to the neighbouring blocks too.
void CellGrid::ActivateAround(std::size_t reach) {
  const std::size_t around = (reach + kBlock - 1) / kBlock;
  std::vector<std::size_t> wanted;
  ForEachRun([&](std::size_t first, std::size_t last) {
    const std::size_t from = first / kBlock;
    const std::size_t to = (last - 1) / kBlock;
    for (std::size_t i = 1; i <= around; ++i) {
      if (from >= i) wanted.push_back(from - i);
      if (to + i < blocks()) wanted.push_back(to + i);
    }
  });
  for (const std::size_t block : wanted) Activate(block);
}

void CellGrid::Move(const Taps& taps) {
  if (taps.weights.empty()) return;
  const std::ptrdiff_t furthest = taps.first + std::ssize(taps.weights) - 1;
  ActivateAround(static_cast<std::size_t>(std::max(std::abs(taps.first), std::abs(furthest))));
  ForEachRun([&](std::size_t first, std::size_t last) {
    const auto count = static_cast<std::ptrdiff_t>(last - first);
    const double* from = cells_.data() + first;
    scratch_.assign(last - first, 0.0);
    for (std::size_t tap = 0; tap < taps.weights.size(); ++tap) {
      const double weight = taps.weights[tap];
      if (weight == 0.0) continue;
      const std::ptrdiff_t by = taps.first + static_cast<std::ptrdiff_t>(tap);
      const std::ptrdiff_t begin = std::clamp<std::ptrdiff_t>(-by, 0, count);
      const std::ptrdiff_t end = std::clamp<std::ptrdiff_t>(count - by, 0, count);
      scratch_.front() += weight * std::accumulate(from, from + begin, 0.0);
      for (std::ptrdiff_t i = begin; i < end; ++i) {
        scratch_[static_cast<std::size_t>(i + by)] += weight * from[i];
      }
      scratch_.back() += weight * std::accumulate(from + end, from + count, 0.0);
    }
    std::copy(scratch_.begin(), scratch_.end(),
              cells_.begin() + static_cast<std::ptrdiff_t>(first));
  });
}

void CellGrid::Add(const CellGrid& other, double factor) {
  for (std::size_t block = 0; block < blocks(); ++block) {
    if (other.active_[block] != 0) Activate(block);
    if (active_[block] == 0) continue;
    const auto [first, last] = CellsOf(block);
    for (std::size_t i = first; i < last; ++i) cells_[i] += factor * other.at(i);
  }
  even_ += factor * other.even_;
}

void CellGrid::Forget(double negligible) {
  double even = even_ * static_cast<double>(even_cells());
  for (std::size_t block = 0; block < blocks(); ++block) {
    if (active_[block] == 0) continue;
    const double mass = MassOf(block);
    if (mass > negligible) continue;
    const auto [first, last] = CellsOf(block);
    active_[block] = 0;
    active_cells_ -= last - first;
    even += mass;
  }
  even_ = even_cells() > 0 ? even / static_cast<double>(even_cells()) : 0.0;
}

double CellGrid::Sum() const {
  double sum = even_ * static_cast<double>(even_cells());
  ForEachRun([&](std::size_t first, std::size_t last) {
    sum = std::accumulate(cells_.begin() + static_cast<std::ptrdiff_t>(first),
                          cells_.begin() + static_cast<std::ptrdiff_t>(last), sum);
  });
  return sum;
}

std::size_t CellGrid::Peak() const {
  std::size_t peak = 0;
  double most = -1.0;
  ForEachRun([&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      if (cells_[i] <= most) continue;
      most = cells_[i];
      peak = i;
    }
  });
  return peak;
}

}  // namespace trailcast::belief
