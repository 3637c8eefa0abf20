#include "services/belief/cell_grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace trailcast::belief {
namespace {

TEST(CellGrid, MovesMassAndLosesNone) {
  CellGrid grid;
  grid.Grow(1000);
  grid.Reset(0.0);
  grid.Set(500, 1.0);
  CellGrid::Taps taps;
  taps.Add(70.25, 0.5);
  taps.Add(-3.0, 0.5);
  grid.Move(taps);
  EXPECT_DOUBLE_EQ(grid.at(570), 0.375);
  EXPECT_DOUBLE_EQ(grid.at(571), 0.125);
  EXPECT_DOUBLE_EQ(grid.at(497), 0.5);
  EXPECT_DOUBLE_EQ(grid.Sum(), 1.0);
  EXPECT_EQ(grid.Peak(), 497U);
}

TEST(CellGrid, WhatWouldLeaveTheLineStaysAtItsEnd) {
  CellGrid grid;
  grid.Grow(100);
  grid.Reset(0.0);
  grid.Set(2, 0.25);
  grid.Set(98, 0.75);
  grid.Move({-5, {1.0}});
  EXPECT_DOUBLE_EQ(grid.at(0), 0.25);
  EXPECT_DOUBLE_EQ(grid.at(93), 0.75);
  grid.Move({10, {1.0}});
  EXPECT_DOUBLE_EQ(grid.at(10), 0.25);
  EXPECT_DOUBLE_EQ(grid.at(99), 0.75);
}

TEST(CellGrid, GrowsWithItsLastBlockInUse) {
  CellGrid grid;
  grid.Grow(10);
  grid.Reset(0.0);
  grid.Set(9, 0.5);
  grid.AddEvenly(0.5);
  for (int i = 0; i < 30; ++i) {
    grid.Grow(11);
    EXPECT_NEAR(grid.Sum(), 1.0, 1e-12);
  }
  EXPECT_EQ(grid.size(), 340U);
  EXPECT_EQ(grid.Peak(), 9U);
}

// Random walks that are weighed now here and now there: as an array of all cells has it.
TEST(CellGrid, IsAsExactAsWhatItForgets) {
  constexpr std::size_t kCells = 700;
  constexpr double kNegligible = 1e-6;
  CellGrid grid;
  grid.Grow(kCells);
  grid.Reset(1.0);
  std::vector<double> all(kCells, 1.0 / kCells);
  std::mt19937 random(3);
  for (int i = 0; i < 300; ++i) {
    const auto by = static_cast<std::ptrdiff_t>(random() % 5U);
    std::vector<double> moved(kCells, 0.0);
    for (std::size_t c = 0; c < kCells; ++c) {
      moved[std::min<std::size_t>(kCells - 1, c + static_cast<std::size_t>(by))] += 0.7 * all[c];
      moved[std::min<std::size_t>(kCells - 1, c + static_cast<std::size_t>(by) + 1)] +=
          0.3 * all[c];
    }
    all = moved;
    grid.Move({by, {0.7, 0.3}});
    const std::size_t first = random() % (kCells - 40);
    const std::vector<double> factors(40, i % 2 == 0 ? 3.0 : 0.4);
    grid.Multiply(first, factors);
    for (std::size_t c = 0; c < factors.size(); ++c) all[first + c] *= factors[c];
    double sum = 0.0;
    for (double& mass : all) sum += mass += 0.001 / kCells;
    grid.AddEvenly(0.001);
    EXPECT_NEAR(grid.Sum(), sum, 0.01 * sum);
    grid.Scale(1.0 / grid.Sum());
    for (double& mass : all) mass /= sum;
    grid.Forget(kNegligible);
  }
  double apart = 0.0;
  for (std::size_t c = 0; c < kCells; ++c) apart += std::abs(grid.at(c) - all[c]);
  EXPECT_LT(apart, 0.01);
}

}  // namespace
}  // namespace trailcast::belief
