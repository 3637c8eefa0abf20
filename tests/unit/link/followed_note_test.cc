#include "agent/link/followed_note.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "services/exchange/bounds.h"
#include "services/exchange/in_process_exchange.h"
#include "tests/support/faulty_exchange.h"
#include "tests/support/pieces.h"

namespace trailcast::agent {
namespace {

using exchange::FollowedSections;
using test::KeyNumber;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

class FollowedNoteTest : public testing::Test {
 protected:
  FollowedNoteTest() {
    route_.key = KeyNumber(1);
    route_.state = route::RouteState::kComplete;
    route_.length_m = 20.0;
  }
  void Note(double along_m, Trust trust = Trust::kSure) {
    ReplayStep step;
    step.along_m = along_m;
    step.trust = trust;
    step.state = StateOf(trust);
    note_.Note(step, route_);
  }
  // From one place to another, five frames a metre.
  void Drive(double from_m, double to_m) {
    for (double along_m = from_m; along_m <= to_m; along_m += 0.2) Note(along_m);
  }
  void Arrive() {
    ReplayStep step;
    step.state = ReplayState::kArrived;
    note_.Note(step, route_);
  }
  // "number: lost of passed" of all that is told.
  std::vector<std::string> Told() {
    note_.Tell(robot_);
    return Heard();
  }
  std::vector<std::string> Heard() {
    std::vector<std::string> told;
    for (const exchange::Message& message : server_->Take(std::chrono::milliseconds(0))) {
      EXPECT_TRUE(exchange::CheckBounds(message));
      const auto& followed = std::get<FollowedSections>(message);
      EXPECT_EQ(followed.agent, AgentId("robot1"));
      for (const FollowedSections::Section& each : followed.sections) {
        told.push_back(fmt::format("{}: {} of {}", each.number, each.lost, each.passed));
      }
    }
    return told;
  }

  exchange::InProcessBus bus_;
  std::unique_ptr<exchange::RouteExchange> server_ =
      bus_.Open({.write = {}, .read = {exchange::Topic::kFollowed}});
  exchange::FaultyExchange robot_{
      bus_.Open({.write = {exchange::Topic::kFollowed}, .read = {}}), {}, 1};
  route::RouteInfo route_;
  FollowedNote note_{AgentId("robot1")};
};

TEST_F(FollowedNoteTest, TellsOnceWhatItCameOver) {
  Drive(0.0, 12.0);
  EXPECT_THAT(Told(), ElementsAre("0: 0 of 1", "1: 0 of 1")) << "it is on the third yet";
  Drive(12.0, 20.3);
  Arrive();
  EXPECT_THAT(Told(), ElementsAre("2: 0 of 1", "3: 0 of 1"))
      << "what is beyond the end is at the end";
  EXPECT_THAT(Told(), IsEmpty());
}

TEST_F(FollowedNoteTest, WhoFindsThePathAgainWasLostThereOnce) {
  Drive(0.0, 6.0);
  Note(6.0, Trust::kUnsure);
  Note(6.0, Trust::kLooking);
  EXPECT_THAT(Told(), ElementsAre("0: 0 of 1", "1: 1 of 1")) << "whatever becomes of it";
  Note(5.8);
  Note(6.1, Trust::kLost);
  Drive(5.9, 11.0);
  Arrive();
  EXPECT_THAT(Told(), ElementsAre("2: 0 of 1"));
}

TEST_F(FollowedNoteTest, StandingAtABorderOfTwoSectionsIsOnePassage) {
  for (int i = 0; i < 20; ++i) Note(i % 2 == 0 ? 4.9 : 5.1);
  EXPECT_THAT(Told(), ElementsAre("0: 0 of 1"));
  Drive(0.0, 6.0);  // it comes anew
  EXPECT_THAT(Told(), ElementsAre("1: 0 of 1", "0: 0 of 1"));
}

TEST_F(FollowedNoteTest, LapsCountEach) {
  for (int lap = 0; lap < 3; ++lap) Drive(0.0, 19.9);
  Arrive();
  EXPECT_THAT(Told(), ElementsAre("0: 0 of 3", "1: 0 of 3", "2: 0 of 3", "3: 0 of 3"));
}

TEST_F(FollowedNoteTest, WhatIsNoFaultOfTheSectionDoesNotCount) {
  Drive(0.0, 3.0);
  Note(3.0, Trust::kCovered);
  Note(3.0, Trust::kLost);
  note_.Begin();
  Note(3.0, Trust::kSeeking);  // it was set down somewhere
  Note(3.0, Trust::kLost);
  note_.Begin();
  ReplayStep step;
  step.along_m = 3.0;
  step.trust = Trust::kSure;
  step.state = ReplayState::kFollowing;
  note_.Note(step, route_);
  step.saw_nothing = true;
  note_.Note(step, route_);
  step.saw_nothing = false;
  step.trust = Trust::kLost;
  step.state = ReplayState::kLost;
  note_.Note(step, route_);
  EXPECT_THAT(Told(), IsEmpty());
}

TEST_F(FollowedNoteTest, WhoOnlyStoodThereHasNotComeOverIt) {
  for (int i = 0; i < 20; ++i) Note(7.0);
  note_.Begin();
  EXPECT_THAT(Told(), IsEmpty());
}

TEST_F(FollowedNoteTest, WhatCouldNotBeSentIsToldAgain) {
  Drive(0.0, 6.0);
  robot_.set_refusing(true);
  EXPECT_THAT(Told(), IsEmpty());
  robot_.set_refusing(false);
  Note(6.0, Trust::kLost);
  EXPECT_THAT(Told(), ElementsAre("0: 0 of 1", "1: 1 of 1"));
}

TEST_F(FollowedNoteTest, TellsOnceInAWhile) {
  const FollowedNote::Clock::time_point at{std::chrono::hours(1)};
  note_.TellIfDue(robot_, at);
  Drive(0.0, 6.0);
  note_.TellIfDue(robot_, at + std::chrono::seconds(9));
  EXPECT_THAT(Heard(), IsEmpty());
  note_.TellIfDue(robot_, at + std::chrono::seconds(10));
  EXPECT_THAT(Heard(), SizeIs(1));
}

TEST_F(FollowedNoteTest, WhatNobodyHearsIsKeptAsFarAsThereIsRoom) {
  route_.length_m = 60'000.0;
  for (int i = 0; i < 5000; ++i) Note(1.0 + 5.0 * i);
  const auto told = Told();
  EXPECT_THAT(told, SizeIs(FollowedNote::kMostSections));
  EXPECT_EQ(told.back(), "4998: 0 of 1") << "what was driven last";
  route_.key = KeyNumber(2);
  for (std::uint32_t i = 0; i <= exchange::kMaxTimesPassed; ++i) {
    Note(4.0);
    Note(4.0, Trust::kLost);
    Note(2.0);
  }
  EXPECT_THAT(Told(), testing::Contains("0: 1000 of 1000"));
}

}  // namespace
}  // namespace trailcast::agent
