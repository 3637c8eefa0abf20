#include "services/exchange/missing_routes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "tests/support/pieces.h"

namespace trailcast::exchange {
namespace {

using std::chrono::milliseconds;
using test::KeyNumber;
using testing::ElementsAre;
using testing::IsEmpty;

class MissingRoutesTest : public testing::Test {
 protected:
  void Hear(const std::string& agent, std::vector<route::RouteKey> held) {
    missing_.Hear({.agent = AgentId(agent), .held = std::move(held)});
  }
  std::vector<route::RouteKey> After(milliseconds passed) {
    now_ += passed;
    return missing_.Due(now_, [&](const route::RouteKey& key) { return here_.contains(key); });
  }

  MissingRoutes missing_;
  MissingRoutes::Time now_{};
  std::set<route::RouteKey> here_{KeyNumber(1)};
};

TEST_F(MissingRoutesTest, AsksForWhatIsNotHereUntilItIs) {
  Hear("scout", {KeyNumber(1), KeyNumber(2)});
  EXPECT_THAT(After(milliseconds(0)), ElementsAre(KeyNumber(2)));
  EXPECT_THAT(After(milliseconds(2'900)), IsEmpty());
  EXPECT_THAT(After(milliseconds(100)), ElementsAre(KeyNumber(2)));
  here_.insert(KeyNumber(2));
  EXPECT_THAT(After(milliseconds(20'000)), IsEmpty());
}

TEST_F(MissingRoutesTest, WhatNobodyAnswersForIsAskedForAgainWhenAListChanges) {
  Hear("robot", {KeyNumber(2)});
  for (int times = 0; times < MissingRoutes::kMostAsked; ++times) {
    EXPECT_EQ(After(MissingRoutes::kAskEvery).size(), 1U);
  }
  EXPECT_THAT(After(MissingRoutes::kAskEvery), IsEmpty());
  Hear("robot", {KeyNumber(2)});
  EXPECT_THAT(After(MissingRoutes::kAskEvery), IsEmpty());
  Hear("robot", {KeyNumber(2), KeyNumber(1)});
  EXPECT_THAT(After(MissingRoutes::kAskEvery), ElementsAre(KeyNumber(2)));
}

TEST_F(MissingRoutesTest, FewAtATime) {
  std::vector<route::RouteKey> held;
  for (unsigned i = 10; i < 10 + 100; ++i) held.push_back(KeyNumber(i));
  Hear("robot", held);
  EXPECT_EQ(After(milliseconds(0)).size(), MissingRoutes::kMostAtATime);
  EXPECT_EQ(After(milliseconds(0)).size(), 100 - MissingRoutes::kMostAtATime);
}

}  // namespace
}  // namespace trailcast::exchange
