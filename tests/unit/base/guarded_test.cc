#include "services/base/guarded.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

namespace trailcast {
namespace {

using testing::AllOf;
using testing::HasSubstr;

TEST(Guarded, WhatItThrowsIsAnErrorThatNamesTheThread) {
  const auto thrown = Guarded("the link", [] { throw std::runtime_error("no such index"); });
  ASSERT_FALSE(thrown);
  EXPECT_EQ(thrown.error().code, ErrorCode::kInternal);
  EXPECT_THAT(thrown.error().message, AllOf(HasSubstr("the link"), HasSubstr("no such index")));
  EXPECT_FALSE(Guarded("the link", [] { throw 7; }));
}

TEST(Guarded, WhatItReturnsIsPassedOn) {
  EXPECT_TRUE(Guarded("the link", [] {}));
  EXPECT_EQ(Guarded("the link", []() -> Result<int> { return 7; }), 7);
  const auto failed = Guarded("the link", []() -> Result<void> {
    return Fail(ErrorCode::kUnavailable, "the disk is full");
  });
  ASSERT_FALSE(failed);
  EXPECT_EQ(failed.error().message, "the disk is full");
}

}  // namespace
}  // namespace trailcast
