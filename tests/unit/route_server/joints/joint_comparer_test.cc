#include "route_server/joints/joint_comparer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/support/await.h"

namespace trailcast::server {
namespace {

TEST(JointComparer, WhatComparingThrowsIsAnErrorOfThatComparisonAlone) {
  JointComparer comparer(
      [](const auto&, const auto& b, bool, const auto&) -> std::vector<joints::Joint> {
        if (!b) throw std::runtime_error("no room for so many views");
        return {joints::Joint{.at_a = 3.0}};
      });
  const auto views = std::make_shared<const joints::RouteViews>(640);
  const auto compare = [&](const JointComparer::Views& with) {
    std::optional<JointComparer::Done> done;
    const auto number = comparer.TryPut(views, with, true);
    EXPECT_TRUE(number);
    test::Await([&] { return (done = comparer.TryGet()).has_value(); }, "what was compared");
    EXPECT_EQ(done->number, number);
    return done->joints;
  };
  const auto failed = compare(nullptr);
  ASSERT_FALSE(failed);
  EXPECT_EQ(failed.error().code, ErrorCode::kInternal);
  EXPECT_THAT(failed.error().message, testing::HasSubstr("no room for so many views"));
  const auto joints = compare(views);
  ASSERT_TRUE(joints) << "it goes on";
  EXPECT_EQ(joints->front().at_a, 3.0);
}

}  // namespace
}  // namespace trailcast::server
