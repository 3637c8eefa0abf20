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

}  // namespace
}  // namespace trailcast::network
