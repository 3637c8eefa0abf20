#include "route_server/followed_lately.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/pieces.h"

namespace trailcast::server {
namespace {

using exchange::PathTrust;
using test::KeyNumber;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;
using Poor = FollowedLately::Poor;

constexpr auto kWeek_ms = static_cast<std::int64_t>(FollowedLately::kHalfAfter_ms);

// Route 1 is 20 m long, route 2 12 m, and route 3 is not known.
class FollowedLatelyTest : public testing::Test {
 protected:
  static std::optional<double> LengthOf(const route::RouteKey& key) {
    if (key == KeyNumber(1)) return 20.0;
    return key == KeyNumber(2) ? std::optional(12.0) : std::nullopt;
  }
  void Hear(const std::string& robot, double along_m, PathTrust trust = PathTrust::kSure,
            unsigned route = 1) {
    followed_.Hear({.agent = AgentId(robot),
                    .role = exchange::AgentRole::kFollower,
                    .place = exchange::PlaceOnRoute{KeyNumber(route), along_m},
                    .path_trust = trust},
                   now_);
  }
  // From one place to another, five words a metre.
  void Drive(const std::string& robot, double from_m, double to_m, unsigned route = 1) {
    for (double along_m = from_m; along_m <= to_m; along_m += 0.2) {
      Hear(robot, along_m, PathTrust::kSure, route);
    }
  }
  [[nodiscard]] std::vector<Poor> Poorly() const { return followed_.Poorly(now_); }
  // "from: lost of passed" of all that is kept, as it counted when it was heard.
  std::vector<std::string> Kept() {
    std::vector<std::string> kept;
    for (const store::FollowedStretch& each : followed_.Unsaved()) {
      kept.push_back(fmt::format("{}: {:g} of {:g}", each.number, each.lost, each.passed));
    }
    return kept;
  }

  std::int64_t now_ = 1'000 * kWeek_ms;
  FollowedLately followed_{LengthOf};
};

TEST_F(FollowedLatelyTest, AStretchCostsMoreByTheShareThatWasLost) {
  for (int i = 0; i < 5; ++i) Drive("robot" + std::to_string(i), 0.0, 20.3);
  EXPECT_THAT(Poorly(), IsEmpty());
  EXPECT_THAT(Kept(), ElementsAre("0: 0 of 5", "1: 0 of 5", "2: 0 of 5", "3: 0 of 5"))
      << "what is beyond the end is at the end";
  for (const char* robot : {"a", "b"}) {
    Drive(robot, 0.0, 7.0);
    Hear(robot, 7.0, PathTrust::kUnsure);
    Hear(robot, 7.2, PathTrust::kLost);
    Hear(robot, 7.2, PathTrust::kLost);
  }
  EXPECT_THAT(Poorly(), ElementsAre(Poor{KeyNumber(1), 5.0, 10.0, 7.0, 2.0, 1.9}));
  for (int i = 0; i < 20; ++i) Drive("robot0", 0.0, 9.0);
  EXPECT_THAT(Poorly(), ElementsAre(Poor{KeyNumber(1), 5.0, 10.0, 27.0, 2.0, 1.3}));
}

TEST_F(FollowedLatelyTest, HoweverManyAreLostItStaysPassable) {
  for (int i = 0; i < 1000; ++i) {
    Hear("robot1", 6.0);
    Hear("robot1", 6.5, PathTrust::kLost);
    Hear("robot1", 1.0);
  }
  ASSERT_THAT(Poorly(), SizeIs(1));
  EXPECT_EQ(Poorly().front().cost, 1.0 + FollowedLately::kLostCosts);
}

TEST_F(FollowedLatelyTest, WhoFindsThePathAgainWasLostThereOnce) {
  Drive("robot1", 0.0, 6.0);
  Hear("robot1", 6.0, PathTrust::kLost);
  Hear("robot1", 5.8);
  Hear("robot1", 6.1, PathTrust::kLost);
  Hear("robot1", 5.9);
  Drive("robot1", 6.0, 11.0);
  EXPECT_THAT(Kept(), ElementsAre("0: 0 of 1", "1: 1 of 1", "2: 0 of 1"));
}

TEST_F(FollowedLatelyTest, StandingAtABorderOfTwoStretchesIsOnePassage) {
  for (int i = 0; i < 20; ++i) Hear("robot1", i % 2 == 0 ? 4.9 : 5.1);
  EXPECT_THAT(Kept(), ElementsAre("0: 0 of 1", "1: 0 of 1"));
  Hear("robot1", 3.0);  // it comes anew
  EXPECT_THAT(Kept(), ElementsAre("1: 0 of 1", "0: 0 of 2"));
}

TEST_F(FollowedLatelyTest, WhatIsNoFaultOfTheStretchDoesNotCount) {
  Drive("robot1", 0.0, 3.0);
  Hear("robot1", 3.0, PathTrust::kUnknown);  // covered, without a picture, or held
  Hear("robot1", 3.0, PathTrust::kLost);
  Hear("robot2", 3.0, PathTrust::kUnsure);  // it was set down somewhere
  Hear("robot2", 3.0, PathTrust::kLost);
  followed_.Hear({.agent = AgentId("robot1"), .role = exchange::AgentRole::kFollower}, now_);
  Hear("robot1", 3.0, PathTrust::kLost);
  EXPECT_THAT(Poorly(), IsEmpty());
  EXPECT_THAT(Kept(), ElementsAre("0: 0 of 1"));
}

TEST_F(FollowedLatelyTest, OfRevisionsAndPlacesThatAreNotKnownNothingCounts) {
  Drive("robot1", 0.0, 6.0, 3);
  Hear("robot1", 6.0, PathTrust::kLost, 3);
  Drive("robot1", 12.6, 16.0, 2);
  Hear("robot1", 16.0, PathTrust::kLost, 2);
  EXPECT_THAT(Kept(), IsEmpty());
  followed_.Hear({.agent = AgentId("robot2"),
                  .role = exchange::AgentRole::kScout,
                  .place = exchange::PlaceOnRoute{KeyNumber(1), 1.0},
                  .path_trust = PathTrust::kSure},
                 now_);
  EXPECT_THAT(Kept(), IsEmpty()) << "nor of who does not follow";
}

TEST_F(FollowedLatelyTest, HalfIsLeftAfterAWeekAndNothingInTheEnd) {
  Hear("robot1", 6.0);
  Hear("robot1", 6.0, PathTrust::kLost);
  EXPECT_THAT(Poorly(), ElementsAre(Poor{KeyNumber(1), 5.0, 10.0, 1.0, 1.0, 2.3}));
  now_ += kWeek_ms;
  EXPECT_THAT(Poorly(), ElementsAre(Poor{KeyNumber(1), 5.0, 10.0, 0.5, 0.5, 1.8}));
  Drive("robot2", 0.0, 6.0);
  EXPECT_THAT(Poorly(), ElementsAre(Poor{KeyNumber(1), 5.0, 10.0, 1.5, 0.5, 1.6}));
  now_ -= 3 * kWeek_ms;  // the clock was set
  EXPECT_EQ(Poorly().front().lost, 0.5);
  now_ += 10 * kWeek_ms;
  EXPECT_THAT(Poorly(), IsEmpty());
}

TEST_F(FollowedLatelyTest, GoesOnAfterARestartWithWhatWasSaved) {
  Drive("robot1", 0.0, 6.0);
  Hear("robot1", 6.0, PathTrust::kLost);
  const auto saved = followed_.Unsaved();
  followed_.NoteSaved();
  EXPECT_THAT(followed_.Unsaved(), IsEmpty());
  FollowedLately again(LengthOf);
  again.Load(saved);
  EXPECT_EQ(again.Poorly(now_), Poorly());
  EXPECT_THAT(again.Unsaved(), IsEmpty());
  Hear("robot2", 6.0);
  EXPECT_THAT(followed_.Unsaved(), SizeIs(1)) << "of what has changed";
}

TEST_F(FollowedLatelyTest, NoMoreIsKeptThanThereIsRoomFor) {
  FollowedLately any([](const route::RouteKey&) { return 5.0; });
  constexpr auto kMost = static_cast<unsigned>(FollowedLately::kMostStretches);
  for (unsigned i = 0; i < kMost + 10; ++i) {
    any.Hear({.agent = AgentId("robot1"),
              .role = exchange::AgentRole::kFollower,
              .place = exchange::PlaceOnRoute{KeyNumber(1, i + 1), 1.0},
              .path_trust = PathTrust::kSure},
             now_);
  }
  const auto kept = any.Unsaved();
  EXPECT_THAT(kept, SizeIs(kMost));
  EXPECT_EQ(kept.front().key, KeyNumber(1, 11)) << "the oldest are gone";
}

}  // namespace
}  // namespace trailcast::server
