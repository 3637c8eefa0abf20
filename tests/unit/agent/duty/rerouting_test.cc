#include "agent/duty/src/rerouting.h"

#include <gtest/gtest.h>

namespace trailcast::agent {
namespace {

using Kind = Rerouting::Kind;

mission::Task TaskIn(const std::string& text) { return mission::ParseOrders(text)->front(); }

struct Case {
  const char* way;
  double along_m;
  Kind kind;
  std::uint32_t task;
};

// It follows 'hall 0..3'.
TEST(ReroutingTest, ARobotGoesOnWhereItIsOnTheOtherWay) {
  for (const Case& each : {
           Case{"follow hall 1..1.5 follow yard 0..3", 1.1, Kind::kGoesOn, 0},
           Case{"follow hall 1..1.5 follow yard 0..3", 0.8, Kind::kGoesOn, 0},
           Case{"follow hall 1..1.5 follow yard 0..3", 1.7, Kind::kGoesOn, 0},
           Case{"follow hall 1..1.5 follow yard 0..3", 1.9, Kind::kMissed, 0},
           Case{"follow hall 1..1.5 follow hall 4..6", 5.0, Kind::kGoesOn, 1},
           Case{"follow yard 0..3 follow hall 1..2", 1.2, Kind::kGoesOn, 1},
           Case{"follow yard 0..3 follow hall 5..6", 1.2, Kind::kBegins, 0},
           Case{"follow hall 1..1.5 speed 0.5 follow yard 0..3", 1.1, Kind::kBegins, 0},
           Case{"follow hall@2 1..1.5", 1.1, Kind::kBegins, 0},
           Case{"wait way", 1.1, Kind::kBegins, 0},
           Case{"follow hall 1..1.5 wait lane follow hall 1.5..6", 1.7, Kind::kGoesOn, 0},
           Case{"follow hall 1..1.5 wait lane follow hall 1.5..6", 1.9, Kind::kMissed, 0},
           Case{"wait lane follow hall 1.5..6", 1.7, Kind::kBegins, 0},
       }) {
    const auto way = mission::ParseOrders("goto bay way 2 " + std::string(each.way));
    ASSERT_TRUE(way) << way.error().message;
    const Rerouting other = FindOnPath(*way, TaskIn("follow hall 0..3"), each.along_m);
    EXPECT_EQ(other.kind, each.kind) << each.way << " at " << each.along_m;
    EXPECT_EQ(other.task, each.task) << each.way << " at " << each.along_m;
  }
}

TEST(ReroutingTest, ARobotThatHasNotFoundItselfBeginsIt) {
  const auto way = mission::ParseOrders("follow hall 0..1 follow yard 0..3");
  EXPECT_EQ(FindOnPath(*way, TaskIn("follow hall 0..3"), std::nullopt).kind, Kind::kBegins);
}

}  // namespace
}  // namespace trailcast::agent
