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
