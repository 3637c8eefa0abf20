#include "services/belief/route_belief.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>
#include <vector>

namespace trailcast::belief {
namespace {

// From a view to the next, things grow by a tenth of their size.
std::vector<ViewPlace> Views(const std::vector<double>& places) {
  std::vector<ViewPlace> views;
  for (const double at : places) views.push_back({at, 0.1});
  return views;
}

// A route of so many metres with a key view at each, and a robot on it.
class Route {
 public:
  explicit Route(int length, RouteBeliefOptions options = {}) : belief(options) {
    for (int i = 0; i < length; ++i) belief.Extend(1.0, Views({0.0}));
  }

  // Shows what a robot at `along` would find: many features at the nearest views, fewer further
  // off, and things looking larger from nearer.
  void See(double along, int peak = 20, double independent = 1.0,
           const std::optional<TrackedPlace>& tracked = std::nullopt) {
    std::vector<ComparedView> compared;
    for (const std::size_t view : belief.WorthComparing(8, 32)) {
      const double off = belief.view_at(view) - along;
      const int agreed = std::max(2, static_cast<int>(peak * (1.0 - 0.4 * std::abs(off))));
      compared.push_back({view, agreed, -0.1 * off});
    }
    belief.Weigh(compared, independent, tracked);
  }
  void SeeNothing(double independent = 1.0) {
    std::vector<ComparedView> compared;
    for (const std::size_t view : belief.WorthComparing(8, 32)) compared.push_back({view, 3, 0.0});
    belief.Weigh(compared, independent);
  }

  // With odometry, from the route's beginning; how far it got.
  double Drive(double to) {
    double along = 0.0;
    for (; along < to; along += 0.3) {
      See(along);
      belief.Move({0.3, 0.015, false});
    }
    return along;
  }

  RouteBelief belief;
};

TEST(RouteBelief, FollowsARobotByOdometry) {
  Route route(100);
  route.belief.StartAt(0.0, 0.5);
  double along = 0.0;
  for (; along < 95.0; along += 0.3) {
    route.See(along);
    EXPECT_TRUE(route.belief.place().held);
    EXPECT_NEAR(route.belief.place().along, along, 0.35);
    route.belief.Move({0.3, 0.015, false});
  }
}

TEST(RouteBelief, HowPlacesLookedLaterTakesTheTurnOfNoneOfTheRoutesOwnViews) {
  RouteBelief belief;
  for (int i = 0; i < 20; ++i) {
    belief.Extend(1.0, std::vector<ViewPlace>{{0.0, 0.1}, {0.0, std::nullopt, false}});
  }
  const std::vector<std::size_t> around = belief.Around(9.5, 6);
  ASSERT_EQ(around.size(), 12U);
  EXPECT_EQ(belief.view_at(around.front()), 7.0);
  EXPECT_EQ(belief.view_at(around.back()), 12.0);
  EXPECT_EQ(belief.Around(0.0, 6).front(), 0U);
  EXPECT_EQ(belief.Around(0.0, 6).back(), 11U);
  EXPECT_EQ(belief.Around(19.5, 6).back(), 39U);
}

TEST(RouteBelief, FollowsARobotWhoseWayNobodyMeasuresAtAnyPace) {
  for (const double pace : {0.35, 1.0, 2.5}) {
    Route route(60);
    route.belief.StartAt(0.0, 0.5);
    int held = 0;
    int looks = 0;
    for (double along = 0.0; along < 55.0; along += 0.2 * pace) {
      route.See(along, 20, 0.3);
      ++looks;
      held += route.belief.place().held && std::abs(route.belief.place().along - along) < 1.0;
      route.belief.Move({0.2, 0.0, true});
    }
    EXPECT_GE(held, 97 * looks / 100) << "pace " << pace;
  }
}

// Odometry that tells so much of the way, besides the guess that is always there.
class Told {
 public:
  explicit Told(double length) : route_(static_cast<int>(length)) {
    route_.belief.StartAt(0.0, 0.5);
  }

  // Drives to there, while odometry tells so many metres for each; returns the share of the looks
  // at which the place was held and right.
  double Drive(double to, double told_per_m) {
    constexpr double kStep_m = 0.2;
    int right = 0;
    int looks = 0;
    for (; along_ < to; along_ += kStep_m) {
      route_.See(along_);
      const RouteBelief::Place& place = route_.belief.place();
      right += place.held && std::abs(place.along - along_) < 1.0;
      ++looks;
      const Motion odometry{told_per_m * kStep_m, 0.01, false};
      route_.belief.Move(std::vector{odometry, Motion{kStep_m, 0.0, true}});
    }
    return right / static_cast<double>(looks);
  }
  [[nodiscard]] double Trust() const { return route_.belief.Trust(0); }
  [[nodiscard]] double Scale() const { return route_.belief.ScaleOf(0); }

 private:
  Route route_;
  double along_ = 0.0;
};

TEST(RouteBelief, BelievesOdometryThatAgreesWithThePictures) {
  Told robot(60);
  EXPECT_EQ(robot.Drive(20.0, 1.0), 1.0);
  EXPECT_GT(robot.Trust(), 0.8);
  EXPECT_NEAR(robot.Scale(), 1.0, 0.05);
}

TEST(RouteBelief, OdometryThatLiesIsNotBelievedAndComesBackOnceItIsRight) {
  for (const double lie : {0.0, -1.0, 4.0}) {
    Told robot(60);
    robot.Drive(10.0, 1.0);
    EXPECT_GE(robot.Drive(20.0, lie), 0.95) << lie;
    EXPECT_LT(robot.Trust(), 0.2) << lie;
    EXPECT_EQ(robot.Drive(40.0, 1.0), 1.0) << lie;
    EXPECT_GT(robot.Trust(), 0.6) << lie;
  }
}

TEST(RouteBelief, LearnsHowFarItComesForEachMetreThatItIsTold) {
  for (const double told_per_m : {0.8, 1.25}) {
    Told robot(60);
    EXPECT_EQ(robot.Drive(40.0, told_per_m), 1.0);
    EXPECT_NEAR(robot.Scale() * told_per_m, 1.0, 0.06) << told_per_m;
    EXPECT_GT(robot.Trust(), 0.5) << told_per_m;
  }
}

// A robot may lose its odometry on the way, or begin to be told.
TEST(RouteBelief, WitnessesComeAndGoWithoutAnyoneLosingThePlace) {
  Route route(60);
  route.belief.StartAt(0.0, 0.5);
  const double along = route.Drive(10.0);
  route.belief.Move(std::vector{Motion{0.0, 0.01, false}, Motion{0.0, 0.0, true}});
  route.See(along);
  EXPECT_TRUE(route.belief.place().held);
  EXPECT_NEAR(route.belief.place().along, along, 0.3);
  EXPECT_NEAR(route.belief.Trust(0), 1.0, 1e-6) << "nothing tells them apart yet";
  EXPECT_NEAR(route.belief.Trust(1), 1.0, 1e-6);
  route.belief.Move({0.0, 0.01, false});
  EXPECT_NEAR(route.belief.Trust(0), 1.0, 1e-6);
}

TEST(RouteBelief, ARobotThatStandsStaysWhereItIs) {
  Route route(60);
  route.belief.StartAt(20.0, 0.5);
  for (int i = 0; i < 200; ++i) {
    route.See(20.0, 20, 0.1);
    EXPECT_NEAR(route.belief.place().along, 20.0, 0.5);
  }
}

TEST(RouteBelief, IsNotSureWhereNothingIsRecognised) {
  Route route(60);
  route.belief.StartAt(0.0, 0.5);
  for (int i = 0; i < 30; ++i) {
    route.SeeNothing();
    route.belief.Move({0.3, 0.015, false});
    EXPECT_FALSE(route.belief.place().held);
  }
  EXPECT_GT(route.belief.place().off_route, 0.95);
}

TEST(RouteBelief, AHandfulOfFeaturesThatAgreeByChanceAreNoPlace) {
  Route route(60);
  std::mt19937 random(1);
  std::binomial_distribution<int> agreed(12, 0.25);  // as in pictures of other buildings
  route.belief.StartAt(0.0, 0.5);
  for (int i = 0; i < 500; ++i) {
    std::vector<ComparedView> compared;
    for (const std::size_t view : route.belief.WorthComparing(8, 32)) {
      compared.push_back({view, agreed(random), 0.0});
    }
    route.belief.Weigh(compared, 1.0);
    route.belief.Move({0.3, 0.0, true});
    EXPECT_FALSE(route.belief.place().held);
  }
}

// This shows views of so many features each, of which so many agree, whatever the place is.
bool IsHeldBy(int agreed, int features) {
  Route route(60);
  route.belief.StartAt(0.0, 0.5);
  for (int i = 0; i < 30; ++i) {
    std::vector<ComparedView> compared;
    for (const std::size_t view : route.belief.WorthComparing(8, 32)) {
      const bool here = std::abs(route.belief.view_at(view)) < 0.5;
      compared.push_back({view, here ? agreed : 2, 0.0, features});
    }
    route.belief.Weigh(compared, 1.0);
  }
  return route.belief.place().held;
}

TEST(RouteBelief, MoreFeaturesOfALargerViewAgreeByChance) {
  EXPECT_FALSE(IsHeldBy(4, 40));
  EXPECT_TRUE(IsHeldBy(5, 40));
  EXPECT_FALSE(IsHeldBy(7, 80));
  EXPECT_TRUE(IsHeldBy(8, 80));
}

TEST(RouteBelief, FindsItselfWhereverItIsPut) {
  for (const double along : {3.0, 31.5, 57.0}) {
    Route route(60);
    route.belief.StartAnywhere();
    int looks = 0;
    while (!route.belief.place().held && looks < 30) {
      route.See(along);
      ++looks;
    }
    EXPECT_LE(looks, 12);
    EXPECT_NEAR(route.belief.place().along, along, 0.5);
  }
}

TEST(RouteBelief, NoticesBeingCarriedAlongTheRoute) {
  Route route(60);
  route.belief.StartAt(0.0, 0.5);
  double along = route.Drive(10.0);
  along = 42.0;
  int looks = 0;
  do {
    route.See(along);
    ++looks;
  } while (looks < 40 &&
           !(route.belief.place().held && std::abs(route.belief.place().along - along) < 1.0));
  EXPECT_LE(looks, 20);
}

TEST(RouteBelief, OneLookElsewhereIsNoProofOfHavingBeenCarried) {
  Route route(60);
  route.belief.StartAt(0.0, 0.5);
  double along = route.Drive(10.0);
  route.See(42.0);
  EXPECT_NEAR(route.belief.place().along, along, 1.0);
  route.belief.Move({0.3, 0.015, false});
  route.See(along + 0.3);
  EXPECT_TRUE(route.belief.place().held);
  EXPECT_NEAR(route.belief.place().along, along + 0.3, 0.5);
}

// Another camera's views may be a little like those of a place some metres off.
TEST(RouteBelief, FeaturesThatAreTrackedHoldAPlaceThatViewsMistake) {
  Route route(60);
  route.belief.StartAt(0.0, 0.5);
  for (double along = 0.0; along < 40.0; along += 0.3) {
    route.See(std::max(0.0, along - 2.0), 10, 1.0, TrackedPlace{along, 25});
    EXPECT_TRUE(route.belief.place().held);
    EXPECT_NEAR(route.belief.place().along, along, 0.5);
    route.belief.Move({0.3, 0.015, false});
  }
}

TEST(RouteBelief, AFewTrackedFeaturesDoNotHideThatItWasCarried) {
  Route route(60);
  route.belief.StartAt(0.0, 0.5);
  const double along = route.Drive(10.0);
  int looks = 0;
  while (looks < 40 && std::abs(route.belief.place().along - 42.0) > 1.0) {
    route.See(42.0, 20, 1.0, TrackedPlace{along, 7});
    ++looks;
  }
  EXPECT_LE(looks, 20);
}

TEST(RouteBelief, WhatAnEarlierRunKnewOfTheMagnificationStands) {
  Route route(60);
  route.belief.KnowMagnification(0.26);
  route.belief.StartAt(0.0, 0.5);
  EXPECT_EQ(route.belief.log_magnification(), 0.26);
}

TEST(RouteBelief, LearnsHowMuchLargerItsCameraShowsThings) {
  Route route(60);
  route.belief.StartAt(0.0, 0.5);
  EXPECT_FALSE(route.belief.log_magnification());
  for (double along = 0.0; along < 20.0; along += 0.3) {
    std::vector<ComparedView> compared;
    for (const std::size_t view : route.belief.WorthComparing(8, 4)) {
      const double off = route.belief.view_at(view) - along;
      compared.push_back(
          {view, std::max(2, static_cast<int>(20 - 8 * std::abs(off))), 0.26 - 0.1 * off});
    }
    route.belief.Weigh(compared, 1.0);
    route.belief.Move({0.3, 0.015, false});
  }
  ASSERT_TRUE(route.belief.log_magnification());
  EXPECT_NEAR(*route.belief.log_magnification(), 0.26, 0.03);
}

// It shows at its size what the scout saw some metres on, and little of what the scout saw here.
TEST(RouteBelief, ALensThatShowsThingsLargerRecognisesWhatIsAheadBest) {
  constexpr double kLarger = 0.5;
  constexpr double kAhead = 2.0;  // the view that is recognised best
  Route route(60);
  route.belief.StartAt(5.0, 0.5);
  route.belief.KnowMagnification(kLarger);
  route.belief.Move({0.0, 0.01, false, true});
  for (double along = 5.0; along < 50.0; along += 0.3) {
    std::vector<ComparedView> compared;
    for (const std::size_t view : route.belief.WorthComparing(10, 4)) {
      const double off = route.belief.view_at(view) - along;
      const double agreed = 18.0 - 6.0 * std::abs(off - kAhead);
      compared.push_back({view, std::max(2, static_cast<int>(agreed)), kLarger - 0.1 * off});
    }
    route.belief.Weigh(compared, 1.0);
    EXPECT_TRUE(route.belief.place().held) << along;
    EXPECT_NEAR(route.belief.place().along, along, 0.5);
    route.belief.Move({0.3, 0.015, false, true});
  }
  EXPECT_NEAR(*route.belief.log_magnification(), kLarger, 0.05);
}

TEST(RouteBelief, ComparesTheNeighboursEachTimeAndTheOthersByTurns) {
  Route route(100);
  route.belief.StartAt(50.0, 0.5);
  std::vector<int> compared(100);
  for (int i = 0; i < 20; ++i) {
    for (const std::size_t view : route.belief.WorthComparing(8, 5)) ++compared[view];
  }
  for (std::size_t view = 47; view < 53; ++view) EXPECT_EQ(compared[view], 20);
  EXPECT_GE(*std::min_element(compared.begin(), compared.end()), 1);
}

TEST(RouteBelief, GrowsWhileItIsFollowed) {
  RouteBelief belief;
  belief.Extend(1.0, Views({0.0}));
  belief.StartAt(0.0, 0.2);
  belief.Move({3.0, 0.1, false});
  EXPECT_LE(belief.place().along, 1.0);
  for (int i = 0; i < 20; ++i) belief.Extend(1.0, Views({0.0, 0.5}));
  EXPECT_EQ(belief.views(), 41U);
  EXPECT_EQ(belief.length(), 21.0);
  belief.Move({2.0, 0.1, false});
  belief.Weigh(std::vector{ComparedView{5, 20, 0.0}}, 1.0);
  EXPECT_NEAR(belief.place().along, 3.0, 0.3);
}

TEST(RouteBelief, ViewsOfATurnOnTheSpotShareTheirPlace) {
  RouteBelief belief;
  for (int i = 0; i < 5; ++i) belief.Extend(1.0, Views({0.0}));
  belief.Extend(1.0, Views({0.0, 0.0, 0.0, 0.5}));
  belief.StartAt(5.0, 0.3);
  belief.Weigh(std::vector{ComparedView{5, 3, 0.0}, ComparedView{6, 25, 0.0},
                           ComparedView{7, 3, 0.0}, ComparedView{4, 3, 0.0}},
               1.0);
  EXPECT_TRUE(belief.place().held);
  EXPECT_NEAR(belief.place().along, 5.0, 0.2);
}

TEST(RouteBelief, ARouteWithoutAViewIsNeverHeld) {
  RouteBelief belief;
  belief.StartAnywhere();
  EXPECT_TRUE(belief.WorthComparing(8, 8).empty());
  belief.Extend(10.0, {});
  belief.StartAt(0.0, 0.5);
  belief.Move({1.0, 0.1, false});
  belief.Weigh({}, 1.0);
  EXPECT_FALSE(belief.place().held);
}

}  // namespace
}  // namespace trailcast::belief
