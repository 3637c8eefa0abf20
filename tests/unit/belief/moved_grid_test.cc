#include "services/belief/moved_grid.h"

#include <gtest/gtest.h>

namespace trailcast::belief {
namespace {

constexpr double kCell = 0.1;

MovedGrid At(double along) {
  MovedGrid grid(kCell);
  grid.cells().Grow(200);
  grid.cells().Reset(0.0);
  grid.cells().Set(grid.CellOf(along), 1.0);
  return grid;
}

TEST(MovedGrid, ManySmallMovesAddUpToOneLargeOne) {
  MovedGrid grid = At(5.05);
  for (int i = 0; i < 1000; ++i) grid.Shift(0.0031);
  EXPECT_NEAR(grid.PlaceOf(grid.cells().Peak()), 5.05 + 3.1, 1e-6);
  for (int i = 0; i < 500; ++i) grid.Shift(-0.0031);
  EXPECT_NEAR(grid.PlaceOf(grid.cells().Peak()), 5.05 + 1.55, 1e-6);
}

TEST(MovedGrid, SpreadsByTheVarianceHoweverItIsCutUp) {
  MovedGrid grid = At(10.05);
  for (int i = 0; i < 400; ++i) grid.Spread(0.0001);
  double variance = 0.0;
  for (std::size_t i = 0; i < grid.cells().size(); ++i) {
    const double off = grid.PlaceOf(i) - 10.05;
    variance += grid.cells().at(i) * off * off;
  }
  EXPECT_NEAR(variance, 0.04, 0.002);
  EXPECT_NEAR(grid.cells().Sum(), 1.0, 1e-9);
}

}  // namespace
}  // namespace trailcast::belief
