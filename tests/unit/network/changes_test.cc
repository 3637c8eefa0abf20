#include "services/network/changes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace trailcast::network {
namespace {

using testing::ElementsAre;

TEST(ChangesTest, AQuestionIsReadAsItIsWritten) {
  EXPECT_EQ(ParseChangesSince(ChangesSince(1'795'647'600'000)), 1'795'647'600'000);
  EXPECT_EQ(ParseChangesSince("way hall@1 office@2"), std::nullopt);
  EXPECT_EQ(ParseChangesSince("changes since monday"), std::nullopt);
  EXPECT_EQ(ParseChangesSince(""), std::nullopt);
}

TEST(ChangesTest, AnAnswerIsReadAsItIsWrittenAndWhatALaterOneHasIsPassedOver) {
  const Change closed{1000, "desk", "close hall 3..7"};
  const Change heard{2000, "", "activated hall@3"};
  const History history = ParseHistory({KeptSince(500), ToText(closed), "weather fine",
                                        ToText(heard), "changed soon desk activated hall@3",
                                        "changed 3000 desk", "changed 3000 desk "});
  EXPECT_EQ(history.kept_since_unix_ms, 500);
  EXPECT_THAT(history.changes, ElementsAre(closed, heard));
}

TEST(ChangesTest, RoutesOfAChangeAreAsTheyAreCalledInTheEnd) {
  const std::vector<std::vector<std::string>> expected{
      {"aisle"},  {"aisle"}, {"aisle", "office"}, {"aisle"}, {"aisle"},   {"hall"},
      {"office"}, {"ring"},  {"aisle", "office"}, {},        {"0a1b2c3"}, {}};
  std::vector<Change> changes;
  for (const char* const what :
       {"stored hall@1, 3.5 m, active", "close hall 3..7", "join hall@1@12 office@0.4 both",
        "described hall@1: was renamed", "renamed hall to aisle", "activated hall@1",
        "name bay office@2", "join ring@31.4 ring@0", "narrow aisle 3..7 office 1..2", "forget bay",
        "open 0a1b2c3", "invented lamp@2"}) {
    changes.push_back({.what = what});
  }
  EXPECT_EQ(RoutesOf(changes), expected);
  EXPECT_TRUE(RoutesOf({}).empty());
}

}  // namespace
}  // namespace trailcast::network
