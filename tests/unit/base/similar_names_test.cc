#include "services/base/similar_names.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace trailcast {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(EditDistance, CountsLettersPutInLeftOutAndChanged) {
  EXPECT_EQ(EditDistance("yard", "yard"), 0U);
  EXPECT_EQ(EditDistance("yard", "yards"), 1U);
  EXPECT_EQ(EditDistance("yard", "yad"), 1U);
  EXPECT_EQ(EditDistance("yard", "yarn"), 1U);
  EXPECT_EQ(EditDistance("kitten", "sitting"), 3U);
  EXPECT_EQ(EditDistance("", "yard"), 4U);
  EXPECT_EQ(EditDistance("yard", ""), 4U);
}

TEST(EditDistance, TakesUpperAndLowerCaseForTheSame) {
  EXPECT_EQ(EditDistance("YARD-2", "yard-2"), 0U);
}

TEST(MostSimilar, NearestComesFirst) {
  EXPECT_THAT(MostSimilar("gardn", {"yard", "garden", "bookshop"}, 10),
              ElementsAre("garden", "yard", "bookshop"));
}

TEST(MostSimilar, NamesThatBeginAlikeComeBeforeNamesOfFewerChanges) {
  EXPECT_THAT(MostSimilar("dock", {"rock", "dock-to-warehouse-7"}, 10),
              ElementsAre("dock-to-warehouse-7", "rock"));
  EXPECT_THAT(MostSimilar("Yard-North", {"bard-north", "yard"}, 10),
              ElementsAre("yard", "bard-north"));
}

TEST(MostSimilar, EachNameOnceAlphabeticallyAmongEqualsAndNoMoreThanAskedFor) {
  EXPECT_THAT(MostSimilar("x", {"c", "b", "a", "b"}, 2), ElementsAre("a", "b"));
  EXPECT_THAT(MostSimilar("x", {}, 10), IsEmpty());
}

TEST(DidYouMean, NamesWhatMayHaveBeenMistyped) {
  EXPECT_EQ(DidYouMean("robot9", {"robot1", "robot2", "robot3", "barrow"}),
            "; did you mean 'robot1' or 'robot2'?");
  EXPECT_EQ(DidYouMean("hal", {"hall", "yard"}), "; did you mean 'hall'?");
  EXPECT_EQ(DidYouMean("hall", {"yard", "corridor"}), "") << "another name altogether";
  EXPECT_EQ(DidYouMean("hall", {}), "");
}

}  // namespace
}  // namespace trailcast
