#include "services/users/throttle.h"

#include <gtest/gtest.h>

namespace trailcast::users {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

class ThrottleTest : public testing::Test {
 protected:
  Throttle::Time now_ = Throttle::Time{} + std::chrono::hours(1000);
  Throttle throttle_{{.free = 2, .first = seconds(1), .longest = seconds(10)}};
};

TEST_F(ThrottleTest, TheWaitGrowsToItsBound) {
  for (int i = 0; i < 2; ++i) {
    throttle_.Fail("anna", now_);
    EXPECT_EQ(throttle_.Wait("anna", now_), milliseconds(0)) << i;
  }
  for (const int expected_s : {1, 2, 4, 8, 10, 10}) {
    throttle_.Fail("anna", now_);
    EXPECT_EQ(throttle_.Wait("anna", now_), seconds(expected_s));
    now_ += seconds(expected_s);
    EXPECT_EQ(throttle_.Wait("anna", now_), milliseconds(0));
  }
  for (int i = 0; i < 100; ++i) throttle_.Fail("anna", now_);
  EXPECT_EQ(throttle_.Wait("anna", now_), seconds(10));
}

TEST_F(ThrottleTest, IsForgottenAndForgiven) {
  for (int i = 0; i < 5; ++i) throttle_.Fail("anna", now_);
  throttle_.Forgive("anna");
  EXPECT_EQ(throttle_.Wait("anna", now_), milliseconds(0));
  for (int i = 0; i < 5; ++i) throttle_.Fail("anna", now_);
  now_ += std::chrono::hours(1);
  throttle_.Fail("anna", now_);
  EXPECT_EQ(throttle_.Wait("anna", now_), milliseconds(0)) << "the first in an hour";
}

TEST_F(ThrottleTest, OthersDoNotWaitAndNobodyCanMakeThePunishedForgotten) {
  for (int i = 0; i < 5; ++i) throttle_.Fail("anna", now_);
  int wait = 0;
  for (int i = 0; i < 1000; ++i) {
    const std::string made_up = "name" + std::to_string(i);
    if (throttle_.Wait(made_up, now_) > milliseconds(0)) ++wait;
    throttle_.Fail(made_up, now_);
  }
  EXPECT_LT(wait, 5) << "of 4096 places";
  EXPECT_GT(throttle_.Wait("anna", now_), milliseconds(0));
}

}  // namespace
}  // namespace trailcast::users
