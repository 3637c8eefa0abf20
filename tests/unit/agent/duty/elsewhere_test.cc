#include "agent/duty/src/elsewhere.h"

#include <gtest/gtest.h>

namespace trailcast::agent {
namespace {

const auto kWay = *mission::ParseOrders(
    "goto bay follow hall 0..3 follow office 2..5 wait lane follow yard 0..9 follow office 7..8");

TEST(ElsewhereTest, LooksOnItsOwnRouteThenOnThoseToComeThenOnThoseBefore) {
  Elsewhere elsewhere;
  EXPECT_FALSE(elsewhere.looks());
  elsewhere.Begin(kWay, 1, "LOST: no path", {});
  ASSERT_TRUE(elsewhere.looks());
  EXPECT_EQ(elsewhere.Lost(), "LOST: no path");
  EXPECT_EQ(mission::ToText(elsewhere.route()), "follow office") << "all along it";
  EXPECT_FALSE(elsewhere.NotThere());
  EXPECT_EQ(elsewhere.route().route.route, "yard");
  EXPECT_FALSE(elsewhere.NotThere());
  EXPECT_EQ(elsewhere.route().route.route, "hall");
  EXPECT_TRUE(elsewhere.NotThere());
  EXPECT_FALSE(elsewhere.looks());
  EXPECT_EQ(elsewhere.Lost(),
            "LOST: no path; and it does not find itself on office or yard or hall");
}

TEST(ElsewhereTest, LooksOnWhatItSeesBeforeTheRestOfItsWay) {
  Elsewhere elsewhere;
  std::string looks;
  elsewhere.Begin(kWay, 3, "LOST", {"dock", "hall"});
  for (bool more = elsewhere.looks(); more; more = !elsewhere.NotThere()) {
    looks += elsewhere.route().route.route + " ";
  }
  EXPECT_EQ(looks, "yard dock hall office ");
}

TEST(ElsewhereTest, LooksSoOftenAndAnewOnceItHasGotFurther) {
  Elsewhere elsewhere;
  for (int i = 0; i < Elsewhere::kMostTimes; ++i) {
    EXPECT_TRUE(elsewhere.MayBegin());
    elsewhere.Begin(kWay, 0, "LOST", {});
    EXPECT_TRUE(elsewhere.looks());
    elsewhere.End();
  }
  EXPECT_FALSE(elsewhere.MayBegin());
  EXPECT_FALSE(elsewhere.looks());
  elsewhere.Reset();
  EXPECT_TRUE(elsewhere.MayBegin());
}

}  // namespace
}  // namespace trailcast::agent
