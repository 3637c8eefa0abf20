#include "services/program/command_line.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace trailcast::program {
namespace {

using testing::HasSubstr;

TEST(WithRevision, TakesItFromEitherPlace) {
  EXPECT_EQ(WithRevision("hall", 0)->revision, 0U);
  EXPECT_EQ(WithRevision("hall", 3)->revision, 3U);
  EXPECT_EQ(WithRevision("hall@3", 0)->revision, 3U);
  EXPECT_EQ(WithRevision("hall@3", 3)->route, "hall");
}

TEST(WithRevision, RefusesTwoThatDiffer) {
  const auto both = WithRevision("hall@3", 2);
  ASSERT_FALSE(both);
  EXPECT_THAT(both.error().message, HasSubstr("'hall@3' is revision 3, and --revision says 2"));
}

}  // namespace
}  // namespace trailcast::program
