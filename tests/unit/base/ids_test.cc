#include "services/base/ids.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <type_traits>
#include <unordered_set>

namespace trailcast {
namespace {

static_assert(!std::is_convertible_v<std::string, RouteId>, "an id is made on purpose");
static_assert(!std::is_convertible_v<RouteId, AgentId>, "and is not taken for another");

TEST(Ids, CompareAndHashByValue) {
  EXPECT_EQ(SegmentIndex(3), SegmentIndex(3));
  EXPECT_LT(SegmentIndex(2), SegmentIndex(10));
  EXPECT_EQ(SegmentIndex().value(), 0U);
  const std::unordered_set<AgentId> agents{AgentId("a"), AgentId("b"), AgentId("a")};
  EXPECT_EQ(agents.size(), 2U);
}

TEST(MakeRouteId, GivesThirtyTwoHexadecimalDigitsNeverTwiceTheSame) {
  std::set<RouteId> ids;
  for (int i = 0; i < 100; ++i) {
    const RouteId id = MakeRouteId();
    EXPECT_THAT(id.value(), testing::MatchesRegex("[0-9a-f]+"));
    EXPECT_EQ(id.value().size(), 32U);
    ids.insert(id);
  }
  EXPECT_EQ(ids.size(), 100U);
}

TEST(IsValidName, AcceptsLettersDigitsAndThreeMarks) {
  for (const char* name : {"a", "Yard_2.b-c", "0", "-", ".."})
    EXPECT_TRUE(IsValidName(name)) << name;
  EXPECT_TRUE(IsValidName(std::string(64, 'x')));
}

TEST(IsValidName, RefusesEverythingElse) {
  for (const char* name : {"", "my yard", "a/b", "a\n", "caf\xc3\xa9", "a'b", "a%"}) {
    EXPECT_FALSE(IsValidName(name)) << name;
  }
  EXPECT_FALSE(IsValidName(std::string(65, 'x')));
  EXPECT_FALSE(IsValidName(std::string("a\0b", 3)));
}

}  // namespace
}  // namespace trailcast
