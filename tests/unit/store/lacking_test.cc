#include "services/store/lacking.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/temp_dir.h"
#include "tests/unit/store/pieces.h"

namespace trailcast::store {
namespace {

TEST(Lacking, SegmentsOfCompleteRoutesThatAreNotThere) {
  test::TempDir dir;
  const auto store = OpenSqliteStore(dir / "routes.db").value();
  ASSERT_TRUE(store->AppendSegments(Pieces({0, 3, 4})));
  ASSERT_TRUE(store->PutRoute(Teaching(5)));
  EXPECT_TRUE(FindLacking(*store).value().empty()) << "more of it may be on its way";
  ASSERT_TRUE(store->PutRoute(Complete(7)));
  const auto lacking = FindLacking(*store).value();
  ASSERT_EQ(lacking.size(), 1U);
  EXPECT_EQ(lacking[0].segments, Indices({1, 2, 5, 6}));
  EXPECT_EQ(Describe(lacking[0]),
            "segments 1 to 2, 5 to 6 of route 'yard' revision - (teaching 1 of route "
            "0123456789abcdef0123456789abcdef)");
  ASSERT_TRUE(store->AppendSegments(Pieces({1, 2, 5, 6})));
  EXPECT_TRUE(FindLacking(*store).value().empty());
}

TEST(Lacking, ALongListSaysHowManyMoreThereAre) {
  EXPECT_EQ(DescribeSegments(Indices({7})), "segment 7");
  std::vector<SegmentIndex> odd;
  for (std::uint32_t i = 1; i < 40; i += 2) odd.emplace_back(i);
  EXPECT_EQ(DescribeSegments(odd), "segments 1, 3, 5, 7, 9, 11, 13, 15, 17, 19 and 10 more");
}

}  // namespace
}  // namespace trailcast::store
