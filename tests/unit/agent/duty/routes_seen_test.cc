#include "agent/duty/src/routes_seen.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "services/route/digest.h"
#include "tests/support/pieces.h"
#include "tests/support/seen_segment.h"
#include "tests/support/temp_dir.h"

namespace trailcast::agent {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

class RoutesSeenTest : public testing::Test {
 protected:
  // Its segments look like those from that number on.
  void Put(unsigned number, const std::string& name, unsigned looks_like,
           route::Standing standing = route::Standing::kActive) {
    constexpr unsigned kSegments = 4;
    std::vector<route::SegmentPiece> pieces;
    for (unsigned i = 0; i < kSegments; ++i) {
      pieces.push_back(
          route::MakePiece(test::KeyNumber(number), test::SegmentToSee(looks_like + i, i)));
    }
    ASSERT_TRUE(store_->AppendSegments(pieces));
    route::RouteInfo info =
        test::InfoOf(test::KeyNumber(number), pieces, route::RouteState::kComplete);
    info.name = name;
    info.standing = standing;
    ASSERT_TRUE(store_->PutRoute(info));
  }
  std::vector<std::string> SeenLike(unsigned number) {
    return RoutesSeen(*store_, test::ViewOf(test::SegmentToSee(number, 0)));
  }

  test::TempDir dir_;
  std::unique_ptr<store::RouteStore> store_ = store::OpenSqliteStore(dir_ / "routes.db").value();
};

TEST_F(RoutesSeenTest, AreThoseThatSomewhereLookLikeThatAndAreNotRetired) {
  Put(1, "hall", 10);
  Put(2, "office", 20);
  Put(3, "old-office", 20, route::Standing::kRetired);
  EXPECT_THAT(SeenLike(12), ElementsAre("hall"));
  EXPECT_THAT(SeenLike(23), ElementsAre("office"));
  EXPECT_THAT(SeenLike(77), IsEmpty());
}

TEST_F(RoutesSeenTest, AreNamedOnceHoweverManyRevisionsAreHeld) {
  Put(1, "hall", 10);
  Put(2, "hall", 10);
  EXPECT_THAT(SeenLike(12), ElementsAre("hall"));
}

TEST_F(RoutesSeenTest, AreFewOfMany) {
  for (unsigned i = 1; i <= 6; ++i) Put(i, "route-" + std::to_string(i), 10);
  EXPECT_EQ(SeenLike(11).size(), 3U);
}

}  // namespace
}  // namespace trailcast::agent
