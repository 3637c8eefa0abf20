#include "route_server/routes/quotas.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/pieces.h"

namespace trailcast::server {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using testing::HasSubstr;

const AgentId kScout("scout-1");
const AgentId kOther("scout-2");

class QuotasTest : public testing::Test {
 protected:
  Quotas With(const QuotaOptions& options) {
    return {options, [this](const AgentId&) -> Result<Quotas::Stored> {
              ++looked_;
              return stored_;
            }};
  }
  Quotas::Time now_{seconds(1000)};
  Quotas::Stored stored_;
  int looked_ = 0;
};

TEST_F(QuotasTest, WithoutAnyNothingIsHeldBack) {
  Quotas quotas = With({});
  EXPECT_EQ(quotas.TakeSegments(kScout, 4096, now_), 4096U);
  EXPECT_TRUE(quotas.TakeRequest(kScout, now_));
  EXPECT_TRUE(quotas.TakeBytes(kScout, 1U << 30U, now_));
  EXPECT_TRUE(quotas.TakeRoute(kScout, test::KeyNumber(1), now_));
  EXPECT_EQ(looked_, 0);
}

TEST_F(QuotasTest, SoManySegmentsASecondOfEach) {
  Quotas quotas = With({.segments_per_s = 10});
  EXPECT_EQ(quotas.TakeSegments(kScout, 7, now_), 7U);
  EXPECT_EQ(quotas.TakeSegments(kScout, 7, now_), 3U);
  EXPECT_EQ(quotas.TakeSegments(kOther, 7, now_), 7U);
  EXPECT_EQ(quotas.TakeSegments(kScout, 7, now_ + milliseconds(250)), 2U);
  EXPECT_EQ(quotas.TakeSegments(kScout, 70, now_ + seconds(100)), 10U)
      << "what was not used lapses";
  EXPECT_THAT(quotas.TooManySegments(kScout).message,
              HasSubstr("over quota: 'scout-1' may have 10 segments a second"));
}

TEST_F(QuotasTest, SoManyRequestsASecondOfEach) {
  Quotas quotas = With({.requests_per_s = 2});
  EXPECT_TRUE(quotas.TakeRequest(kScout, now_));
  EXPECT_TRUE(quotas.TakeRequest(kScout, now_));
  const auto refused = quotas.TakeRequest(kScout, now_);
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message, HasSubstr("may ask 2 times a second"));
  EXPECT_TRUE(quotas.TakeRequest(kOther, now_));
  EXPECT_TRUE(quotas.TakeRequest(kScout, now_ + milliseconds(500)));
}

TEST_F(QuotasTest, WhatIsStoredOfAScoutAndWhatWasTakenSinceCounts) {
  Quotas quotas = With({.stored_bytes = 10'000'000});
  stored_.bytes = 9'000'000;
  EXPECT_TRUE(quotas.TakeBytes(kScout, 600'000, now_));
  const auto refused = quotas.TakeBytes(kScout, 600'000, now_);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kUnavailable);
  EXPECT_THAT(refused.error().message,
              HasSubstr("routes of 'scout-1' may take 10.0 MB here, and take 9.6 MB"));
  EXPECT_EQ(looked_, 1);
  stored_.bytes = 0;  // an operator deleted them
  EXPECT_TRUE(quotas.TakeBytes(kScout, 600'000, now_ + Quotas::kLookAgain));
}

TEST_F(QuotasTest, SoManyRoutesOfEachScout) {
  Quotas quotas = With({.routes = 3});
  stored_.routes = 2;
  EXPECT_TRUE(quotas.TakeRoute(kScout, test::KeyNumber(1), now_));
  EXPECT_TRUE(quotas.TakeRoute(kScout, test::KeyNumber(1), now_)) << "the same again";
  const auto refused = quotas.TakeRoute(kScout, test::KeyNumber(2), now_);
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message, HasSubstr("may have 3 routes here"));
  stored_.routes = 0;  // an operator deleted them
  EXPECT_TRUE(quotas.TakeRoute(kScout, test::KeyNumber(2), now_ + Quotas::kLookAgain));
}

}  // namespace
}  // namespace trailcast::server
