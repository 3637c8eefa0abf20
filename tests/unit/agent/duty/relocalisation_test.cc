#include "agent/duty/src/relocalisation.h"

#include <gtest/gtest.h>

namespace trailcast::agent {
namespace {

const auto kWay = *mission::ParseOrders(
    "goto bay follow hall 0..3 follow office 2..5 wait lane follow yard 0..9 follow office 7..8");

TEST(RelocalisationTest, LooksOnItsOwnRouteThenOnThoseToComeThenOnThoseBefore) {
  Relocalisation relocalisation;
  EXPECT_FALSE(relocalisation.looks());
  relocalisation.Begin(kWay, 1, "LOST: no path", {});
  ASSERT_TRUE(relocalisation.looks());
  EXPECT_EQ(relocalisation.Lost(), "LOST: no path");
  EXPECT_EQ(mission::ToText(relocalisation.route()), "follow office") << "all along it";
  EXPECT_FALSE(relocalisation.NotThere());
  EXPECT_EQ(relocalisation.route().route.route, "yard");
  EXPECT_FALSE(relocalisation.NotThere());
  EXPECT_EQ(relocalisation.route().route.route, "hall");
  EXPECT_TRUE(relocalisation.NotThere());
  EXPECT_FALSE(relocalisation.looks());
  EXPECT_EQ(relocalisation.Lost(),
            "LOST: no path; and it does not find itself on office or yard or hall");
}

TEST(RelocalisationTest, LooksOnWhatItSeesBeforeTheRestOfItsWay) {
  Relocalisation relocalisation;
  std::string looks;
  relocalisation.Begin(kWay, 3, "LOST", {"dock", "hall"});
  for (bool more = relocalisation.looks(); more; more = !relocalisation.NotThere()) {
    looks += relocalisation.route().route.route + " ";
  }
  EXPECT_EQ(looks, "yard dock hall office ");
}

TEST(RelocalisationTest, LooksSoOftenAndAnewOnceItHasGotFurther) {
  Relocalisation relocalisation;
  for (int i = 0; i < Relocalisation::kMostTimes; ++i) {
    EXPECT_TRUE(relocalisation.MayBegin());
    relocalisation.Begin(kWay, 0, "LOST", {});
    EXPECT_TRUE(relocalisation.looks());
    relocalisation.End();
  }
  EXPECT_FALSE(relocalisation.MayBegin());
  EXPECT_FALSE(relocalisation.looks());
  relocalisation.Reset();
  EXPECT_TRUE(relocalisation.MayBegin());
}

}  // namespace
}  // namespace trailcast::agent
