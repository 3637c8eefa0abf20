#include "agent/elsewhere.h"

#include <gtest/gtest.h>

namespace trailcast::agent {
namespace {

const auto kWay = *mission::ParseOrders(
    "goto bay follow hall 0..3 follow office 2..5 wait lane follow yard 0..9 follow office 7..8");

constexpr Elsewhere::Turning kStands{.knows_lens = true};

TEST(ElsewhereTest, LooksOnItsOwnRouteThenOnThoseToComeThenOnThoseBefore) {
  Elsewhere elsewhere;
  EXPECT_FALSE(elsewhere.looks());
  ASSERT_TRUE(elsewhere.Begin(kWay, 1, "LOST: no path", {}, kStands));
  EXPECT_EQ(elsewhere.Lost(), "LOST: no path");
  EXPECT_EQ(mission::ToText(elsewhere.now().route), "follow office") << "all along it";
  EXPECT_FALSE(elsewhere.NotThere());
  EXPECT_EQ(elsewhere.now().route.route.route, "yard");
  EXPECT_FALSE(elsewhere.NotThere());
  EXPECT_EQ(elsewhere.now().route.route.route, "hall");
  EXPECT_FALSE(elsewhere.now().turns);
  EXPECT_TRUE(elsewhere.NotThere());
  EXPECT_FALSE(elsewhere.looks());
  EXPECT_EQ(elsewhere.Lost(),
            "LOST: no path; and it does not find itself on office or yard or hall");
}

std::string LooksOf(const Elsewhere::Turning& turning) {
  Elsewhere elsewhere;
  std::string looks;
  for (bool more = elsewhere.Begin(kWay, 3, "LOST", {"dock", "hall"}, turning); more;
       more = !elsewhere.NotThere()) {
    looks += elsewhere.now().route.route.route + (elsewhere.now().turns ? "~ " : " ");
  }
  return looks;
}

TEST(ElsewhereTest, TurnsOnceAllWasLookedAtOrAtOnceIfItDoesNotKnowItsCamera) {
  EXPECT_EQ(LooksOf({.knows_lens = true, .may_turn = true}),
            "yard dock hall office yard~ dock~ hall~ office~ ");
  EXPECT_EQ(LooksOf({.knows_lens = false, .may_turn = true}), "yard~ dock~ hall~ office~ ");
  EXPECT_EQ(LooksOf({.knows_lens = false, .may_turn = false}), "yard dock hall office ");
}

TEST(ElsewhereTest, LooksSoOftenAndAnewOnceItHasGotFurther) {
  Elsewhere elsewhere;
  for (int i = 0; i < Elsewhere::kMostTimes; ++i) {
    EXPECT_TRUE(elsewhere.Begin(kWay, 0, "LOST", {}, kStands));
    elsewhere.End();
  }
  EXPECT_FALSE(elsewhere.Begin(kWay, 0, "LOST", {}, kStands));
  EXPECT_FALSE(elsewhere.looks());
  elsewhere.Reset();
  EXPECT_TRUE(elsewhere.Begin(kWay, 0, "LOST", {}, kStands));
}

}  // namespace
}  // namespace trailcast::agent
