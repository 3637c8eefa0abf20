#include "route_server/junctions/junction_comparer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/support/await.h"

namespace trailcast::server {
namespace {

TEST(JunctionComparer, WhatComparingThrowsIsAnErrorOfThatComparisonAlone) {
  JunctionComparer comparer(
      [](const auto&, const auto& b, bool, const auto&) -> std::vector<junctions::Junction> {
        if (!b) throw std::runtime_error("no room for so many views");
        return {junctions::Junction{.at_a = 3.0}};
      });
  const auto views = std::make_shared<const junctions::RouteViews>(640);
  const auto compare = [&](const JunctionComparer::Views& with) {
    std::optional<JunctionComparer::Done> done;
    const auto number = comparer.TryPut(views, with, true);
    EXPECT_TRUE(number);
    test::Await([&] { return (done = comparer.TryGet()).has_value(); }, "what was compared");
    EXPECT_EQ(done->number, number);
    return done->junctions;
  };
  const auto failed = compare(nullptr);
  ASSERT_FALSE(failed);
  EXPECT_EQ(failed.error().code, ErrorCode::kInternal);
  EXPECT_THAT(failed.error().message, testing::HasSubstr("no room for so many views"));
  const auto junctions = compare(views);
  ASSERT_TRUE(junctions) << "it goes on";
  EXPECT_EQ(junctions->front().at_a, 3.0);
}

}  // namespace
}  // namespace trailcast::server
