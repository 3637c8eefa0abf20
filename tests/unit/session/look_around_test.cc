#include "agent/session/look_around.h"

#include <gtest/gtest.h>

#include <vector>

namespace trailcast::agent {
namespace {

// To which sides it turns, one after the other, until it has looked everywhere.
std::vector<double> RatesOf(LookingAround& looking) {
  constexpr double kFrame_s = 0.1;
  std::vector<double> rates_radps;
  for (double turned_rad = 0.0; looking.Turn(turned_rad, kFrame_s);) {
    const double rate_radps = looking.turn_rate_radps();
    if (rates_radps.empty() || rates_radps.back() != rate_radps) rates_radps.push_back(rate_radps);
    turned_rad = rate_radps * kFrame_s;
  }
  return rates_radps;
}

TEST(LookingAround, TurnsToBothSidesAndBackOnce) {
  LookingAround looking(0.8);
  const std::vector<double> rates_radps = RatesOf(looking);
  ASSERT_EQ(rates_radps.size(), 3U);
  EXPECT_GT(rates_radps[0], 0.0);
  EXPECT_LT(rates_radps[1], 0.0);
  EXPECT_GT(rates_radps[2], 0.0);
  EXPECT_FALSE(looking.Turn(0.0, 0.1));
  EXPECT_FALSE(looking.turns());
}

TEST(LookingAround, BeginsAnewOnceItHasRested) {
  LookingAround looking(0.8);
  const std::vector<double> first = RatesOf(looking);
  looking.Rest();
  EXPECT_FALSE(looking.turns());
  EXPECT_EQ(RatesOf(looking), first);
  // In mid-turn, too.
  looking.Rest();
  ASSERT_TRUE(looking.Turn(0.0, 0.1));
  ASSERT_TRUE(looking.Turn(0.5, 0.1));
  looking.Rest();
  EXPECT_FALSE(looking.turns());
  EXPECT_EQ(looking.turn_rate_radps(), 0.0);
  EXPECT_EQ(RatesOf(looking), first);
}

}  // namespace
}  // namespace trailcast::agent
