#include "services/network/network.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <random>

namespace trailcast::network {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// hall (20 m) leads at 12 m to the beginning of office (10 m), and at its end to yard (30 m), whose
// end leads to office's 4 m; ring (8 m) to its own beginning.
class NetworkTest : public testing::Test {
 protected:
  [[nodiscard]] Network Made() const {
    auto made = Network::Build(routes_, junctions_, conditions_);
    EXPECT_TRUE(made) << made.error().message;
    return *std::move(made);
  }
  [[nodiscard]] Way Found(const Place& from, const Place& to) const {
    auto way = Made().ShortestWay(from, to);
    EXPECT_TRUE(way) << way.error().message;
    return way.value_or(Way{});
  }
  [[nodiscard]] std::string Why(const Place& from, const Place& to) const {
    const auto way = Made().ShortestWay(from, to);
    EXPECT_FALSE(way);
    if (way) return "";
    EXPECT_EQ(way.error().code, ErrorCode::kNotFound);
    return way.error().message;
  }

  std::vector<Route> routes_{
      {"h", "hall", 20.0}, {"o", "office", 10.0}, {"y", "yard", 30.0}, {"r", "ring", 8.0}};
  std::vector<Junction> junctions_{{{"h", 12.0}, {"o", 0.0}},
                                   {{"h", 20.0}, {"y", 0.0}},
                                   {{"y", 30.0}, {"o", 4.0}},
                                   {{"r", 8.0}, {"r", 0.0}}};
  std::vector<Condition> conditions_;
};

TEST_F(NetworkTest, AWayLeadsOverJunctionsInTheDirectionThatWasTaught) {
  const Way way = Found({"h", 2.0}, {"o", 8.0});
  EXPECT_THAT(way.sections, ElementsAre(Section{"h", 2.0, 12.0}, Section{"o", 0.0, 8.0}));
  EXPECT_DOUBLE_EQ(way.length_m, 18.0);
  EXPECT_THAT(Found({"h", 2.0}, {"h", 13.0}).sections, ElementsAre(Section{"h", 2.0, 13.0}));
  EXPECT_THAT(Found({"h", 2.0}, {"h", 2.0}).sections, IsEmpty());
  EXPECT_THAT(Found({"h", 12.0}, {"o", 0.0}).sections, IsEmpty()) << "it stands at the junction";
  EXPECT_THAT(Why({"o", 1.0}, {"h", 2.0}),
              AllOf(HasSubstr("no way leads from office@1 to hall@2"), HasSubstr("junctions")));
  EXPECT_THAT(Why({"h", 5.0}, {"h", 2.0}), HasSubstr("no way leads from hall@5 to hall@2"));
}

TEST_F(NetworkTest, AJunctionOfBothWaysLeadsBack) {
  junctions_.push_back({{"o", 10.0}, {"h", 1.0}, true});
  EXPECT_THAT(Found({"o", 9.0}, {"h", 3.0}).sections,
              ElementsAre(Section{"o", 9.0, 10.0}, Section{"h", 1.0, 3.0}));
  EXPECT_THAT(Found({"h", 0.0}, {"o", 10.0}).sections, ElementsAre(Section{"h", 0.0, 1.0}));
}

TEST_F(NetworkTest, ARingIsDrivenOnToWhatLiesBehind) {
  EXPECT_THAT(Found({"r", 6.0}, {"r", 2.0}).sections,
              ElementsAre(Section{"r", 6.0, 8.0}, Section{"r", 0.0, 2.0}));
  EXPECT_THAT(Found({"r", 2.0}, {"r", 6.0}).sections, ElementsAre(Section{"r", 2.0, 6.0}));
}

TEST_F(NetworkTest, AClosedSectionIsAvoidedOrNamed) {
  conditions_ = {{.route = "o", .from_m = 1.0, .to_m = 2.0, .closed = true}};
  EXPECT_THAT(
      Found({"h", 2.0}, {"o", 8.0}).sections,
      ElementsAre(Section{"h", 2.0, 20.0}, Section{"y", 0.0, 30.0}, Section{"o", 4.0, 8.0}));
  EXPECT_THAT(Found({"h", 2.0}, {"o", 1.0}).sections,
              ElementsAre(Section{"h", 2.0, 12.0}, Section{"o", 0.0, 1.0}))
      << "up to where it is closed";
  EXPECT_THAT(Found({"o", 2.0}, {"o", 3.0}).sections, ElementsAre(Section{"o", 2.0, 3.0}));
  EXPECT_THAT(
      Why({"h", 2.0}, {"o", 1.5}),
      AllOf(HasSubstr("every way from hall@2 to office@1.5 is closed"), HasSubstr("office 1..2")));
  conditions_.push_back({.route = "h", .from_m = 15.0, .to_m = 16.0, .closed = true});
  conditions_.push_back({.route = "h", .from_m = 16.0, .to_m = 1e7, .closed = true});
  EXPECT_THAT(Why({"h", 2.0}, {"y", 3.0}), HasSubstr("on the least closed: hall 15..20"));
  EXPECT_THAT(Why({"h", 17.0}, {"h", 18.0}), HasSubstr("hall 16..20"));
}

TEST_F(NetworkTest, ARobotThatIsOnAClosedPartDrivesOutOfItAndIntoNoOther) {
  conditions_ = {{.route = "h", .from_m = 4.0, .to_m = 14.0, .closed = true}};
  const auto way = [this](const Place& from, const Place& to) { return Made().WayOn(from, to); };
  EXPECT_THAT(way({"h", 6.0}, {"o", 8.0})->sections,
              ElementsAre(Section{"h", 6.0, 12.0}, Section{"o", 0.0, 8.0}))
      << "by a junction within it";
  EXPECT_THAT(way({"h", 6.0}, {"h", 9.0})->sections, ElementsAre(Section{"h", 6.0, 9.0}));
  EXPECT_THAT(way({"h", 6.0}, {"y", 1.0})->sections,
              ElementsAre(Section{"h", 6.0, 20.0}, Section{"y", 0.0, 1.0}));
  for (const double barely_m : {3.0, 4.0, 4.3}) {
    EXPECT_THAT(way({"h", barely_m}, {"o", 8.0}).error().message, HasSubstr("hall 4..14"));
  }
  const auto closed = [this](double from_m, double to_m) {
    const auto first = Made().FirstClosed({"h", from_m, to_m});
    return first ? first->from_m : -1.0;
  };
  EXPECT_EQ(closed(1.0, 4.0), -1.0) << "its ends are no part of it";
  EXPECT_EQ(closed(1.0, 4.1), 4.0);
  EXPECT_EQ(closed(4.3, 20.0), 4.0) << "it has barely come in";
  EXPECT_EQ(closed(6.0, 20.0), -1.0);
  EXPECT_EQ(Made().ClosedAround({"h", 6.0}), conditions_.front());
  EXPECT_EQ(Made().ClosedAround({"h", 13.0}), conditions_.front());
  for (const double out_m : {3.0, 4.0, 4.3, 14.0}) EXPECT_FALSE(Made().ClosedAround({"h", out_m}));
  EXPECT_EQ(closed(14.0, 20.0), -1.0);
  conditions_.push_back({.route = "h", .from_m = 15.0, .to_m = 16.0, .closed = true});
  EXPECT_EQ(closed(6.0, 20.0), 15.0);
  EXPECT_THAT(way({"h", 6.0}, {"y", 1.0}).error().message, HasSubstr("hall 15..16"));
}

// A robot that drives backwards looks where it looked before, so it goes on ahead from anywhere.
TEST_F(NetworkTest, WhereItMayARobotDrivesBackwards) {
  EXPECT_THAT(Why({"o", 8.0}, {"o", 3.0}), HasSubstr("no way leads"));
  conditions_ = {{.route = "o", .from_m = 2.0, .to_m = 9.0, .backed = true}};
  EXPECT_THAT(Found({"o", 8.0}, {"o", 3.0}).sections, ElementsAre(Section{"o", 8.0, 3.0}));
  EXPECT_DOUBLE_EQ(Found({"o", 8.0}, {"o", 3.0}).length_m, 5.0);
  EXPECT_THAT(Found({"o", 9.0}, {"o", 2.0}).sections, ElementsAre(Section{"o", 9.0, 2.0}));
  EXPECT_THAT(Why({"o", 8.0}, {"o", 1.0}), HasSubstr("no way leads"));
  EXPECT_THAT(Why({"o", 9.5}, {"o", 3.0}), HasSubstr("no way leads"));
  junctions_.push_back({{"o", 4.5}, {"r", 1.0}});
  EXPECT_THAT(Found({"o", 8.0}, {"r", 3.0}).sections,
              ElementsAre(Section{"o", 8.0, 4.5}, Section{"r", 1.0, 3.0}));
  EXPECT_THAT(Found({"h", 12.0}, {"o", 8.0}).sections, ElementsAre(Section{"o", 0.0, 8.0}));
  EXPECT_THAT(Found({"o", 2.0}, {"o", 9.0}).sections, ElementsAre(Section{"o", 2.0, 9.0}));
}

TEST_F(NetworkTest, BackwardsAMetreCountsAsTwo) {
  conditions_ = {{.route = "r", .from_m = 0.0, .to_m = 8.0, .backed = true}};
  EXPECT_THAT(Found({"r", 5.0}, {"r", 3.0}).sections, ElementsAre(Section{"r", 5.0, 3.0}));
  EXPECT_THAT(Found({"r", 7.0}, {"r", 2.0}).sections,
              ElementsAre(Section{"r", 7.0, 8.0}, Section{"r", 0.0, 2.0}))
      << "the ring is shorter";
  conditions_.push_back({.route = "r", .from_m = 1.0, .to_m = 4.0, .speed = 0.5});
  EXPECT_THAT(Found({"r", 5.0}, {"r", 3.0}).sections,
              ElementsAre(Section{"r", 5.0, 4.0}, Section{"r", 4.0, 3.0, 0.5}));
}

TEST_F(NetworkTest, WhatIsClosedIsSoBackwards) {
  conditions_ = {{.route = "o", .from_m = 1.0, .to_m = 9.0, .backed = true},
                 {.route = "o", .from_m = 4.0, .to_m = 6.0, .closed = true}};
  EXPECT_THAT(Why({"o", 8.0}, {"o", 3.0}), HasSubstr("on the least closed: office 4..6"));
  EXPECT_THAT(Found({"o", 8.0}, {"o", 6.0}).sections, ElementsAre(Section{"o", 8.0, 6.0}));
  const Network network = Made();
  EXPECT_EQ(network.FirstClosed({"o", 8.0, 3.0})->from_m, 4.0);
  EXPECT_EQ(network.FirstClosed({"o", 8.0, 6.0}), std::nullopt);
  EXPECT_EQ(network.FirstClosed({"o", 4.0, 1.0}), std::nullopt);
  EXPECT_EQ(network.FirstClosed({"o", 5.0, 1.0}), std::nullopt) << "it is in there";
  const auto out = network.WayOn({"o", 5.0}, {"o", 3.0});
  ASSERT_TRUE(out) << out.error().message;
  EXPECT_THAT(out->sections, ElementsAre(Section{"o", 5.0, 3.0}));
}

TEST_F(NetworkTest, WhoChangesOverToTheOppositeWayTurnsRound) {
  constexpr double kRound_rad = 3.0;
  junctions_ = {{{"h", 12.0}, {"o", 1.0}, true, Lie{.turn_rad = kRound_rad}},
                {{"o", 10.0}, {"y", 0.0}, false, Lie{.turn_rad = 0.4}}};
  const auto there = Found({"h", 2.0}, {"y", 5.0}).sections;
  EXPECT_THAT(there, ElementsAre(Section{"h", 2.0, 12.0}, Section{"o", 1.0, 10.0, 1.0, kRound_rad},
                                 Section{"y", 0.0, 5.0}));
  EXPECT_THAT(Found({"o", 0.0}, {"h", 15.0}).sections,
              ElementsAre(Section{"o", 0.0, 1.0}, Section{"h", 12.0, 15.0, 1.0, -kRound_rad}));
  EXPECT_FALSE(GoesOn({"h", 2.0, 12.0}, {"h", 12.0, 13.0, 1.0, kRound_rad}));
  EXPECT_FALSE(GoesOn({"h", 2.0, 12.0}, {"h", 12.0, 11.0}));
}

TEST_F(NetworkTest, SpeedAndCostDecideAndSpeedIsToldOfEachSection) {
  conditions_ = {{.route = "o", .from_m = 2.0, .to_m = 3.0, .speed = 0.5}};
  EXPECT_THAT(Found({"h", 11.0}, {"o", 8.0}).sections,
              ElementsAre(Section{"h", 11.0, 12.0}, Section{"o", 0.0, 2.0},
                          Section{"o", 2.0, 3.0, 0.5}, Section{"o", 3.0, 8.0}));
  conditions_.push_back({.route = "o", .from_m = 1.0, .to_m = 2.0, .cost = 100.0});
  const Way way = Found({"h", 11.0}, {"o", 8.0});
  EXPECT_DOUBLE_EQ(way.length_m, 43.0) << "round by the yard, in metres that are driven";
  EXPECT_THAT(way.sections.back(), (Section{"o", 4.0, 8.0}));
}

TEST_F(NetworkTest, OfWaysOfAboutOneLengthThatWithFewerJunctionsIsTaken) {
  routes_.push_back({"s", "short cut", 3.9});
  junctions_.push_back({{"h", 1.0}, {"s", 0.0}});
  junctions_.push_back({{"s", 3.9}, {"h", 5.0}});
  EXPECT_THAT(Found({"h", 0.0}, {"h", 6.0}).sections, ElementsAre(Section{"h", 0.0, 6.0}));
  junctions_.back().to.along_m = 10.0;
  EXPECT_EQ(Found({"h", 0.0}, {"h", 12.0}).sections.size(), 3U);
}

TEST_F(NetworkTest, WhatIsNotThereIsNamed) {
  EXPECT_THAT(Why({"x", 1.0}, {"h", 2.0}), HasSubstr("no route 'x'"));
  EXPECT_THAT(Why({"h", 1.0}, {"o", 11.0}), HasSubstr("'office' is 10.0 m long: there is no 11 m"));
  EXPECT_THAT(Why({"h", -1.0}, {"o", 1.0}), HasSubstr("there is no -1 m"));
  EXPECT_THAT(Why({"h", std::numeric_limits<double>::quiet_NaN()}, {"o", 1.0}), HasSubstr("nan"));
  EXPECT_THAT(Found({"h", 20.3}, {"y", 1.0}).sections, ElementsAre(Section{"y", 0.0, 1.0}))
      << "a robot that has arrived may stand a little beyond the end";
  junctions_.push_back({{"h", 30.0}, {"o", 0.0}});
  const auto beyond = Network::Build(routes_, junctions_, {});
  ASSERT_FALSE(beyond);
  EXPECT_THAT(beyond.error().message, HasSubstr("a junction: route 'hall' is 20.0 m long"));
  EXPECT_FALSE(Network::Build({{"h", "hall", 1.0}, {"h", "hall", 1.0}}, {}, {}));
  conditions_ = {{.route = "x", .to_m = 1.0, .closed = true}};
  junctions_.pop_back();
  EXPECT_TRUE(Network::Build(routes_, junctions_, conditions_));
}

// Random networks, beside all ways of up to so many junctions, tried one by one.
TEST_F(NetworkTest, NoShorterWayIsThereThanTheOneFound) {
  std::mt19937 random(7);
  const auto metres = [&](double most) {
    return static_cast<double>(random() % 101) / 100.0 * most;
  };
  constexpr double kLength_m = 10.0;
  int found = 0;
  for (int trial = 0; trial < 500; ++trial) {
    const std::vector<Route> routes{
        {"a", "a", kLength_m}, {"b", "b", kLength_m}, {"c", "c", kLength_m}};
    const auto place = [&] { return Place{routes[random() % 3].id, metres(kLength_m)}; };
    std::vector<Junction> junctions;
    for (int i = 0; i < 5; ++i) junctions.push_back({place(), place()});
    const std::vector<Condition> conditions{
        {.route = "b", .from_m = 4.0, .to_m = 5.0, .closed = true},
        {.route = "c", .from_m = 3.0, .to_m = 8.0, .backed = true}};
    const Place from = place();
    const Place to = place();
    constexpr double kNever = std::numeric_limits<double>::infinity();
    const auto ahead = [&](const Place& begin, const Place& end) {
      const bool barred = begin.route == "b" && begin.along_m < 5.0 && end.along_m > 4.0;
      const bool backs = begin.route == "c" && end.route == "c" && begin.along_m <= 8.0 &&
                         end.along_m >= 3.0 && begin.along_m > end.along_m;
      if (backs) return Network::kBackwardsCosts * (begin.along_m - end.along_m);
      if (begin.route != end.route || begin.along_m > end.along_m) return kNever;
      return barred && begin.along_m < end.along_m ? kNever : end.along_m - begin.along_m;
    };
    const std::function<double(const Place&, int)> best = [&](const Place& at, int junctions_left) {
      double least = ahead(at, to);
      if (junctions_left == 0) return least;
      for (const Junction& junction : junctions) {
        const double there = ahead(at, junction.from);
        if (there == kNever) continue;
        least = std::min(least,
                         there + Network::kChangeCosts_m + best(junction.to, junctions_left - 1));
      }
      return least;
    };
    const double least = best(from, 5);
    const auto way = Network::Build(routes, junctions, conditions)->ShortestWay(from, to);
    ASSERT_EQ(way.has_value(), least < kNever) << trial;
    if (!way) continue;
    ++found;
    EXPECT_NEAR(LengthOf(way->sections), way->length_m, 1e-9);
    double cost = 0.0;
    for (const Section& section : way->sections) {
      cost += section.length_m() * (section.backwards() ? Network::kBackwardsCosts : 1.0);
    }
    EXPECT_LE(cost, least + 1e-9) << trial;
    EXPECT_GE(cost, least - 5 * Network::kChangeCosts_m - 1e-9) << trial;
  }
  EXPECT_GT(found, 80);
}

}  // namespace
}  // namespace trailcast::network
