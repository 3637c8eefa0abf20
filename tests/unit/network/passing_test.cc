#include "services/network/passing.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace trailcast::network {
namespace {

TEST(PassingTest, AQuestionIsReadAsItIsWritten) {
  EXPECT_EQ(ParseWhatPasses(WhatPasses("hall@12.3")), "hall@12.3");
  EXPECT_EQ(ParseWhatPasses("way hall@1 office@2"), std::nullopt);
  EXPECT_EQ(ParseWhatPasses("passing"), std::nullopt);
}

TEST(PassingTest, AnAnswerIsReadAsItIsWrittenAndWhatALaterOneHasIsPassedOver) {
  const Junction junction{{"hall", 12.0}, {"office", 0.0}, true};
  const Passing joined{{"office", 0.3}, junction, std::nullopt};
  const Passing proposed{{"yard@2", 7.25}, junction, 0.93};
  const Passings read = ParsePassings(
      {AtPlace({"hall", 12.3}), ToText(joined), "weather fine", ToText(proposed), "passes",
       "passes office", "passes office@1", "passes office@1 close hall", "passes @1 join a@1 b@2"});
  EXPECT_EQ(read, (Passings{{"hall", 12.3}, {joined, proposed}}));
}

}  // namespace
}  // namespace trailcast::network
