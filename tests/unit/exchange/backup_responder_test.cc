#include "services/exchange/backup_responder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/pieces.h"

namespace trailcast::exchange {
namespace {

using std::chrono::milliseconds;
using test::Indices;
using test::KeyNumber;
using testing::IsEmpty;

const AgentId kRobot("robot-1");

AgentStatus ServerStatus(const std::string& name, AgentMode mode = AgentMode::kWaiting) {
  AgentStatus status;
  status.agent = AgentId(name);
  status.instance = 7;
  status.role = AgentRole::kServer;
  status.mode = mode;
  return status;
}

class BackupResponderTest : public testing::Test {
 protected:
  BackupResponderTest() {
    for (BackupResponder* one : {&a_, &b_}) {
      for (const char* name : {"server-a", "server-b"}) one->Handle(ServerStatus(name), now_);
    }
    BackupResponder looking(AgentId("server-a"));
    looking.Handle(ServerStatus("server-b"), now_);
    const auto is_own = [&] {
      return !looking.Mine(kRobot, owned_by_b_, Indices(0, 1), now_).empty();
    };
    bool own = is_own();
    // Every second route is, more or less.
    for (int i = 0; own && i < 100; ++i) {
      owned_by_b_ = KeyNumber(++number_);
      own = is_own();
    }
    EXPECT_FALSE(own);
  }
  // All that is due.
  std::vector<SegmentIndex> Due(BackupResponder& one, milliseconds passed) {
    now_ += passed;
    auto due = one.Due(now_);
    return due.contains(owned_by_b_) ? due[owned_by_b_] : std::vector<SegmentIndex>();
  }
  std::vector<SegmentIndex> Mine(BackupResponder& one, std::uint32_t first, std::uint32_t end,
                                 const AgentId& requester = kRobot) {
    return one.Mine(requester, owned_by_b_, Indices(first, end), now_);
  }
  void BSends(std::uint32_t index) {
    a_.Handle(SegmentBatch{AgentId("server-b"), {test::PieceOf(owned_by_b_, index)}}, now_);
  }

  BackupResponder::Time now_{std::chrono::hours(1)};
  BackupResponder a_{AgentId("server-a")};
  BackupResponder b_{AgentId("server-b")};
  unsigned number_ = 1;
  route::RouteKey owned_by_b_ = KeyNumber(number_);
};

TEST_F(BackupResponderTest, OneOfTwoAnswersAndBothDoForSomeRoutes) {
  int of_a = 0;
  for (unsigned number = 0; number < 200; ++number) {
    const bool a = !a_.Mine(kRobot, KeyNumber(number), Indices(0, 1), now_).empty();
    const bool b = !b_.Mine(kRobot, KeyNumber(number), Indices(0, 1), now_).empty();
    EXPECT_NE(a, b) << "route " << number;
    of_a += a ? 1 : 0;
  }
  EXPECT_GT(of_a, 50);
  EXPECT_LT(of_a, 150);
}

TEST_F(BackupResponderTest, AloneItAnswersEverything) {
  a_.Handle(AgentGone{AgentId("server-b"), 7}, now_);
  EXPECT_EQ(Mine(a_, 0, 3), Indices(0, 3));
  a_.Handle(ServerStatus("server-b"), now_);
  EXPECT_THAT(Mine(a_, 3, 6), IsEmpty());
  a_.Handle(ServerStatus("server-b", AgentMode::kStopped), now_);
  EXPECT_EQ(Mine(a_, 6, 9), Indices(6, 9));
}

TEST_F(BackupResponderTest, StandsInForWhatTheOtherDoesNotSend) {
  EXPECT_THAT(Mine(a_, 0, 3), IsEmpty());
  EXPECT_THAT(Due(a_, milliseconds(299)), IsEmpty());
  EXPECT_EQ(Due(a_, milliseconds(1)), Indices(0, 3));
  EXPECT_THAT(Due(a_, milliseconds(1000)), IsEmpty()) << "once";
}

TEST_F(BackupResponderTest, WaitsAsLongAsTheOtherSends) {
  EXPECT_THAT(Mine(a_, 0, 4), IsEmpty());
  for (const std::uint32_t index : {0U, 1U, 2U}) {
    EXPECT_THAT(Due(a_, milliseconds(200)), IsEmpty());
    BSends(index);
  }
  EXPECT_EQ(Due(a_, milliseconds(300)), Indices(3, 4));
}

TEST_F(BackupResponderTest, WhatIsOnItsWayToOthersIsNotWaitedFor) {
  BSends(0);
  EXPECT_THAT(Mine(a_, 0, 1), IsEmpty());
  EXPECT_THAT(Due(a_, milliseconds(2000)), IsEmpty());
}

TEST_F(BackupResponderTest, WhoAsksAgainIsAnsweredByAll) {
  EXPECT_THAT(Mine(a_, 0, 2), IsEmpty());
  BSends(0);
  now_ += milliseconds(1000);
  EXPECT_EQ(Mine(a_, 0, 1), Indices(0, 1)) << "it did not arrive";
  EXPECT_THAT(Mine(a_, 0, 1, AgentId("robot-2")), IsEmpty()) << "who asks for the first time";
}

TEST_F(BackupResponderTest, AServerThatHasNotGotTheRouteIsNotWaitedForEachTime) {
  EXPECT_THAT(Mine(a_, 0, 1), IsEmpty());
  EXPECT_EQ(Due(a_, milliseconds(300)), Indices(0, 1));
  EXPECT_EQ(Mine(a_, 1, 5), Indices(1, 5));
  now_ += BackupResponderOptions().silent_for;
  EXPECT_THAT(Mine(a_, 5, 9), IsEmpty()) << "it may have it by now";
}

TEST_F(BackupResponderTest, WhatAServerAsksForIsNotLeftToItself) {
  EXPECT_EQ(Mine(a_, 0, 2, AgentId("server-b")), Indices(0, 2));
}

TEST_F(BackupResponderTest, AFloodIsNotRememberedWithoutEnd) {
  std::size_t mine = 0;
  constexpr std::uint32_t kAsked = 4 * BackupResponder::kMostRemembered;
  for (std::uint32_t first = 0; first < kAsked; first += 1024) {
    mine += Mine(a_, first, first + 1024).size();
  }
  EXPECT_EQ(Due(a_, milliseconds(300)).size(), BackupResponder::kMostRemembered);
  EXPECT_EQ(mine, kAsked - BackupResponder::kMostRemembered) << "answered as if it were alone";
}

}  // namespace
}  // namespace trailcast::exchange
