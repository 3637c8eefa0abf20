#include "services/network/lanes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace trailcast::network {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

std::vector<std::vector<Section>> SectionsOf(const std::vector<Leg>& legs) {
  std::vector<std::vector<Section>> all;
  for (const Leg& leg : legs) all.push_back(leg.sections);
  return all;
}

// Where hall is narrow, and the way back along it.
const std::vector<Lane> kLanes{{{{"hall", 10.0, 14.0}, {"back", 26.0, 30.0}}}};

TEST(LanesTest, AWayWaitsBeforeALaneAndNeedsItWithTheRoomBeyond) {
  const std::vector<Section> way{{"hall", 2.0, 20.0}, {"office", 0.0, 8.0}};
  const auto legs = LegsOf(way, kLanes);
  EXPECT_THAT(SectionsOf(legs),
              ElementsAre(ElementsAre(Section{"hall", 2.0, 9.5}),
                          ElementsAre(Section{"hall", 9.5, 20.0}, Section{"office", 0.0, 8.0})));
  EXPECT_THAT(legs[0].lanes, IsEmpty());
  EXPECT_THAT(legs[1].lanes, ElementsAre(0U));
  EXPECT_DOUBLE_EQ(legs[1].through_m, 6.5);
  EXPECT_THAT(LegsOf(way, kLanes, {0}), SizeIs(1)) << "it has it";
  EXPECT_THAT(LegsOf(way, kLanes, {}, 8.0), SizeIs(1)) << "it cannot stop before it";
  EXPECT_THAT(LegsOf(way, {}), SizeIs(1));
}

TEST(LanesTest, WhoBeginsInOneDrivesOutOfItAndWhoBeginsBeforeItWaitsAtOnce) {
  EXPECT_THAT(LegsOf(std::vector<Section>{{"hall", 12.0, 20.0}}, kLanes), SizeIs(1));
  EXPECT_THAT(LegsOf(std::vector<Section>{{"hall", 15.0, 20.0}}, kLanes), SizeIs(1)) << "beyond it";
  for (const double from_m : {9.8, 10.3}) {
    const auto legs = LegsOf(std::vector<Section>{{"hall", from_m, 20.0}}, kLanes);
    ASSERT_THAT(legs, SizeIs(2)) << from_m;
    EXPECT_THAT(legs[0].sections, IsEmpty()) << from_m;
  }
  EXPECT_THAT(LegsOf(std::vector<Section>{{"hall", 2.0, 9.9}}, kLanes), SizeIs(1))
      << "it ends before it";
}

TEST(LanesTest, WhoComesOntoTheRouteRightBeforeALaneOrIntoItsRoomWaitsOnTheRouteBefore) {
  for (const double to_m : {8.9, 15.5}) {
    const auto legs =
        LegsOf(std::vector<Section>{{"yard", 0.0, 5.0}, {"hall", to_m, 20.0}}, kLanes);
    EXPECT_THAT(SectionsOf(legs), ElementsAre(ElementsAre(Section{"yard", 0.0, 5.0}),
                                              ElementsAre(Section{"hall", to_m, 20.0})));
  }
  EXPECT_THAT(LegsOf(std::vector<Section>{{"yard", 0.0, 5.0}, {"hall", 16.1, 20.0}}, kLanes),
              SizeIs(1));
}

TEST(LanesTest, LanesWithoutRoomBetweenThemAreNeededAtOnce) {
  std::vector<Lane> lanes = kLanes;
  const std::vector<Section> way{{"hall", 0.0, 40.0}};
  lanes.push_back({{{"hall", 17.0, 18.0}}});
  const auto at_once = LegsOf(way, lanes);
  ASSERT_THAT(at_once, SizeIs(2));
  EXPECT_THAT(at_once[1].lanes, ElementsAre(0U, 1U));
  EXPECT_DOUBLE_EQ(at_once[1].through_m, 10.5);
  lanes[1].parts[0] = {"hall", 17.6, 18.0};
  const auto apart = LegsOf(way, lanes);
  ASSERT_THAT(apart, SizeIs(3));
  EXPECT_THAT(apart[2].sections, ElementsAre(Section{"hall", 17.1, 40.0}));
}

TEST(LanesTest, ARobotIsInALaneUntilItIsOutOfIt) {
  const auto on = [](double at_m) {
    return LanesOn(std::vector<Section>{{"back", at_m, 40.0}}, kLanes);
  };
  EXPECT_THAT(on(0.0), ElementsAre(0U));
  EXPECT_THAT(on(30.4), ElementsAre(0U));
  EXPECT_THAT(on(30.6), IsEmpty());
  EXPECT_THAT(LanesOn(std::vector<Section>{{"yard", 0.0, 5.0}, {"back", 31.0, 40.0}}, kLanes),
              ElementsAre(0U))
      << "nobody else is to come out there";
  EXPECT_THAT(LanesAt({"back", 26.2}, kLanes), IsEmpty()) << "it has stopped late";
  EXPECT_THAT(LanesAt({"back", 26.2}, kLanes, false, 0.0), ElementsAre(0U));
  EXPECT_THAT(LanesAt({"back", 30.4}, kLanes), ElementsAre(0U));
  EXPECT_THAT(LanesAt({"back", 30.6}, kLanes), IsEmpty());
}

TEST(LanesTest, WhoDrivesBackwardsComesInAtTheOtherEnd) {
  const auto legs = LegsOf(std::vector<Section>{{"hall", 20.0, 4.0}, {"yard", 0.0, 5.0}}, kLanes);
  EXPECT_THAT(SectionsOf(legs),
              ElementsAre(ElementsAre(Section{"hall", 20.0, 14.5}),
                          ElementsAre(Section{"hall", 14.5, 4.0}, Section{"yard", 0.0, 5.0})));
  EXPECT_DOUBLE_EQ(legs[1].through_m, 6.5);
  EXPECT_THAT(LegsOf(std::vector<Section>{{"hall", 12.0, 4.0}}, kLanes), SizeIs(1));
  EXPECT_THAT(LegsOf(std::vector<Section>{{"hall", 13.8, 4.0}}, kLanes), SizeIs(2));
  EXPECT_THAT(LegsOf(std::vector<Section>{{"hall", 20.0, 14.1}}, kLanes), SizeIs(1));
  // Out of it, after it has come in ahead.
  EXPECT_THAT(LegsOf(std::vector<Section>{{"hall", 11.0, 13.0}, {"hall", 13.0, 4.0}}, kLanes),
              SizeIs(1));
  const auto on = [](double at_m) {
    return LanesOn(std::vector<Section>{{"hall", at_m, 2.0}}, kLanes);
  };
  EXPECT_THAT(on(20.0), ElementsAre(0U));
  EXPECT_THAT(on(9.6), ElementsAre(0U));
  EXPECT_THAT(on(9.4), IsEmpty());
  EXPECT_THAT(LanesAt({"hall", 13.8}, kLanes, true), IsEmpty()) << "it has stopped late";
  EXPECT_THAT(LanesAt({"hall", 13.8}, kLanes, true, 0.0), ElementsAre(0U));
  EXPECT_THAT(LanesAt({"hall", 9.6}, kLanes, true), ElementsAre(0U));
  EXPECT_THAT(LanesAt({"hall", 9.4}, kLanes, true), IsEmpty());
}

}  // namespace
}  // namespace trailcast::network
