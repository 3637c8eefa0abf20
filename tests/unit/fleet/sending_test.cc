#include "services/fleet/sending.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace trailcast::fleet {
namespace {

using mission::Report;
using mission::State;
using std::chrono::milliseconds;
using testing::HasSubstr;

constexpr milliseconds kSoon{10};
constexpr milliseconds kTimeout{5000};
constexpr milliseconds kLate{6000};

class SendingTest : public testing::Test {
 protected:
  bool Hear(std::uint32_t change, State state, const std::string& detail = "") {
    return sending_.Hear(Report{.agent = AgentId("robot1"),
                                .mission = "m1",
                                .change = change,
                                .state = state,
                                .detail = detail,
                                .relayed = change == 0});
  }
  std::string Error() const {
    const auto outcome = sending_.Outcome(kTimeout);
    return outcome ? "" : outcome.error().message;
  }
  Sending sending_{{.agent = AgentId("robot1"), .id = "m1", .orders = "follow hall"}};
};

TEST_F(SendingTest, WhatIsPutOffIsNotAnsweredAndItsSenderIsToldWhyInTheEnd) {
  EXPECT_THAT(Error(), HasSubstr("neither robot1 nor a route server answered within 5.0 s"));
  const milliseconds again = sending_.SayAgain();
  EXPECT_FALSE(Hear(0, State::kPutOff, "over quota: again later"));
  EXPECT_FALSE(sending_.Answered(kSoon, kTimeout));
  EXPECT_EQ(sending_.SayAgain(), again) << "as soon as if nobody had answered";
  EXPECT_TRUE(sending_.Answered(kLate, kTimeout));
  EXPECT_THAT(Error(), HasSubstr("the mission for robot1 was put off: over quota: again later"));
}

TEST_F(SendingTest, WhatIsTakenAfterwardsIsSent) {
  (void)Hear(0, State::kPutOff, "over quota");
  EXPECT_TRUE(Hear(0, State::kSent));
  EXPECT_FALSE(Hear(0, State::kPutOff, "over quota")) << "of the same mission, said once more";
  ASSERT_TRUE(sending_.Outcome(kTimeout));
  EXPECT_EQ(sending_.Outcome(kTimeout)->state, State::kSent);
}

TEST_F(SendingTest, ARobotThatTakesItNeedsNoServer) {
  (void)Hear(0, State::kPutOff, "over quota");
  EXPECT_TRUE(Hear(1, State::kUnderWay));
  EXPECT_TRUE(sending_.Answered(kSoon, kTimeout));
}

class SendingToAllTest : public testing::Test {
 protected:
  static Report Of(const std::string& agent, std::uint32_t change, State state,
                   const std::string& detail = "") {
    return {.agent = AgentId(agent),
            .mission = "m1",
            .change = change,
            .state = state,
            .detail = detail,
            .relayed = change == 0};
  }
  static SendingToAll To(const std::string& whom) {
    return SendingToAll({.agent = AgentId(whom), .id = "m1", .orders = "follow hall"});
  }
};

TEST_F(SendingToAllTest, AGroupsMissionIsThatOfTheRobotThatTakesIt) {
  SendingToAll sending = To("@cart");
  EXPECT_TRUE(sending.Hear(Of("@cart", 0, State::kSent, "waits")));
  EXPECT_TRUE(sending.Hear(Of("cart-2", 0, State::kSent)));
  EXPECT_FALSE(sending.Hear(Of("@cart", 0, State::kSent, "waits"))) << "an old report, once more";
  EXPECT_FALSE(sending.Hear(Of("cart-1", 1, State::kUnderWay))) << "another one's of that name";
  EXPECT_TRUE(sending.Hear(Of("cart-2", 1, State::kUnderWay)));
  const auto outcome = sending.Outcome(kTimeout);
  ASSERT_TRUE(outcome);
  ASSERT_EQ(outcome->size(), 1U);
  EXPECT_EQ(outcome->front().agent, AgentId("cart-2"));
  EXPECT_FALSE(To("@cart").Hear(Of("lift-1", 1, State::kUnderWay)));
}

TEST_F(SendingToAllTest, OneForSeveralIsAnsweredOnceAllHaveAnsweredOrItIsRefusedForAll) {
  SendingToAll sending = To("lift,@cart");
  EXPECT_TRUE(sending.Hear(Of("lift", 1, State::kUnderWay)));
  EXPECT_FALSE(sending.Answered(kSoon, kTimeout));
  EXPECT_TRUE(sending.Hear(Of("cart-1", 1, State::kUnderWay)));
  EXPECT_TRUE(sending.Answered(kSoon, kTimeout));
  EXPECT_EQ(sending.Outcome(kTimeout)->size(), 2U);
  SendingToAll refused = To("lift,cart-1");
  EXPECT_TRUE(refused.Hear(Of("lift,cart-1", 0, State::kRefused, "no such order")));
  EXPECT_TRUE(refused.Answered(kSoon, kTimeout));
  ASSERT_EQ(refused.Outcome(kTimeout)->size(), 1U);
  EXPECT_EQ(refused.Outcome(kTimeout)->front().detail, "no such order");
  SendingToAll put_off = To("lift,cart-1");
  EXPECT_FALSE(put_off.Hear(Of("lift,cart-1", 0, State::kPutOff, "over quota")));
  EXPECT_THAT(put_off.Outcome(kTimeout).error().message,
              HasSubstr("the mission for lift,cart-1 was put off: over quota"));
}

TEST_F(SendingTest, WhatIsAcceptedMayBeRefusedYet) {
  EXPECT_TRUE(Hear(1, State::kAccepted));
  EXPECT_FALSE(sending_.Answered(kSoon, kTimeout));
  EXPECT_TRUE(Hear(2, State::kFetching));
  EXPECT_FALSE(sending_.Answered(kSoon, kTimeout)) << "it looks whether there is such a route";
  EXPECT_TRUE(sending_.Answered(kLate, kTimeout)) << "a long route is long in coming";
  EXPECT_TRUE(Hear(3, State::kRefused, "there is no route 'nowhere'"));
  EXPECT_TRUE(sending_.Answered(kSoon, kTimeout));
}

TEST_F(SendingTest, WhatIsRefusedIsRefusedForGood) {
  EXPECT_TRUE(Hear(0, State::kRefused, "'dance'"));
  EXPECT_TRUE(sending_.Answered(kSoon, kTimeout));
  EXPECT_EQ(sending_.Outcome(kTimeout)->detail, "'dance'");
}

}  // namespace
}  // namespace trailcast::fleet
