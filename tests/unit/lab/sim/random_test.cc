#include "services/lab/sim/core/random.h"

#include <gtest/gtest.h>

#include <array>

namespace trailcast::sim {
namespace {

TEST(Random, SameSeedAndStreamRepeatOthersDiffer) {
  Random first(7, "slip");
  Random second(7, "slip");
  Random other_stream(7, "pixels");
  Random other_seed(8, "slip");
  const auto bits = first.Bits();
  EXPECT_EQ(bits, second.Bits());
  EXPECT_NE(bits, other_stream.Bits());
  EXPECT_NE(bits, other_seed.Bits());
}

TEST(Random, NormalHasMeanZeroAndVarianceOne) {
  Random random(1, "test");
  double sum = 0.0;
  double squares = 0.0;
  constexpr int kDraws = 100000;
  for (int i = 0; i < kDraws; ++i) {
    const double x = random.Normal();
    sum += x;
    squares += x * x;
  }
  EXPECT_NEAR(sum / kDraws, 0.0, 0.015);
  EXPECT_NEAR(squares / kDraws, 1.0, 0.02);
}

TEST(Random, IntegersCoverTheirRangeAndStayInIt) {
  Random random(1, "test");
  std::array<int, 4> counts{};
  for (int i = 0; i < 4000; ++i) ++counts.at(static_cast<std::size_t>(random.Integer(2, 5) - 2));
  for (const int count : counts) EXPECT_NEAR(count, 1000, 150);
}

}  // namespace
}  // namespace trailcast::sim
