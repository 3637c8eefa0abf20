#include "services/catalog/view_catalog.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "services/catalog/catalog.h"
#include "services/exchange/bounds.h"
#include "services/route/digest.h"
#include "tests/support/memory_store.h"
#include "tests/support/pieces.h"
#include "tests/support/seen_segment.h"
#include "tests/support/temp_dir.h"

namespace trailcast::catalog {
namespace {

using test::KeyNumber;
using test::SegmentToSee;
using test::ViewOf;
using testing::HasSubstr;
using testing::IsEmpty;

class ViewCatalogTest : public testing::Test {
 protected:
  // Route `number` of so many segments, the first of them number 10 `number`.
  void Put(unsigned number, unsigned from, unsigned to) {
    std::vector<route::SegmentPiece> pieces;
    for (unsigned i = from; i < to; ++i) {
      pieces.push_back(route::MakePiece(KeyNumber(number), SegmentToSee(10 * number + i, i)));
    }
    ASSERT_TRUE(store_->AppendSegments(pieces));
    route::RouteInfo info;
    info.key = KeyNumber(number);
    info.name = fmt::format("route-{}", number);
    info.scout = AgentId("scout");
    info.taught_unix_ms = number;
    info.segment_count = to;
    ASSERT_TRUE(store_->PutRoute(info));
  }
  void FillAll(ViewCatalog& views) {
    for (int slices = 0; slices < 1000 && !views.Filled(); ++slices) EXPECT_TRUE(views.Fill(5));
    EXPECT_TRUE(views.Filled());
  }
  static exchange::CatalogReply Ask(ViewCatalog& views, const route::RouteQuery& query) {
    return views.Answer({AgentId("robot"), 77, query}, AgentId("server"));
  }
  static exchange::CatalogReply AskFor(ViewCatalog& views, unsigned number) {
    return Ask(views, {.view = ViewOf(SegmentToSee(number, 0))});
  }

  test::TempDir dir_;
  std::unique_ptr<store::RouteStore> store_ = store::OpenSqliteStore(dir_ / "routes.db").value();
};

TEST_F(ViewCatalogTest, FindsWhereThatIs) {
  Put(1, 0, 10);
  Put(2, 0, 10);
  ViewCatalog views(*store_);
  FillAll(views);
  const auto reply = AskFor(views, 23);
  EXPECT_EQ(reply.server, AgentId("server"));
  EXPECT_EQ(reply.client, AgentId("robot"));
  EXPECT_EQ(reply.request, 77U);
  EXPECT_EQ(reply.error, "");
  ASSERT_EQ(reply.places.size(), 1U);
  EXPECT_EQ(reply.places[0].key, KeyNumber(2));
  EXPECT_EQ(reply.places[0].segment, SegmentIndex(3));
  EXPECT_GT(reply.places[0].score, 0.5);
  ASSERT_EQ(reply.page.routes.size(), 1U);
  EXPECT_EQ(reply.page.routes[0].name, "route-2");
  EXPECT_EQ(reply.coverage, (route::ViewCoverage{20, 20, 0}));
  EXPECT_TRUE(exchange::CheckBounds(reply));
}

TEST_F(ViewCatalogTest, FindsNothingOfAnotherWorld) {
  Put(1, 0, 10);
  ViewCatalog views(*store_);
  FillAll(views);
  const auto reply = AskFor(views, 999);
  EXPECT_THAT(reply.places, IsEmpty());
  EXPECT_THAT(reply.page.routes, IsEmpty());
  EXPECT_EQ(reply.error, "");
  EXPECT_EQ(reply.coverage.segments_indexed, 10U);
}

TEST_F(ViewCatalogTest, SaysHowMuchItKnowsWhileItFills) {
  for (unsigned route = 1; route <= 3; ++route) Put(route, 0, 10);
  ViewCatalog views(*store_);
  EXPECT_EQ(AskFor(views, 35).coverage, (route::ViewCoverage{0, 0, 3}));
  ASSERT_TRUE(views.Fill(6));  // a page, the newest route, four of its segments
  EXPECT_EQ(AskFor(views, 30).coverage, (route::ViewCoverage{4, 10, 2}));
  EXPECT_EQ(AskFor(views, 30).places.size(), 1U);
  EXPECT_THAT(AskFor(views, 35).places, IsEmpty());
  FillAll(views);
  EXPECT_EQ(AskFor(views, 35).coverage, (route::ViewCoverage{30, 30, 0}));
}

TEST_F(ViewCatalogTest, LearnsWhatIsTaughtMeanwhile) {
  Put(1, 0, 3);
  ViewCatalog views(*store_);
  FillAll(views);
  Put(1, 3, 6);
  Put(2, 0, 2);
  views.Note(KeyNumber(1));
  views.Note(KeyNumber(2));
  views.Note(KeyNumber(1));
  EXPECT_FALSE(views.Filled());
  FillAll(views);
  EXPECT_EQ(views.index().size(), 8U);
  EXPECT_EQ(AskFor(views, 15).places.size(), 1U);
  EXPECT_EQ(AskFor(views, 20).places.size(), 1U);
}

TEST_F(ViewCatalogTest, LearnsSegmentsThatItIsToldOfOnceEach) {
  Put(1, 0, 6);
  ViewCatalog views(*store_, {.most_segments = 20});
  const auto add = [&](std::uint32_t segment) {
    EXPECT_TRUE(views.Add(store_->ReadSegment(KeyNumber(1), SegmentIndex(segment)).value()));
  };
  for (const std::uint32_t segment : {4U, 2U, 4U}) add(segment);
  EXPECT_EQ(views.index().size(), 2U);
  FillAll(views);
  add(4);
  FillAll(views);
  EXPECT_EQ(views.index().size(), 6U);
}

TEST_F(ViewCatalogTest, RoutesThatAreMadeUpAreNotNotedWithoutEnd) {
  ViewCatalog views(*store_);
  for (unsigned i = 0; i < 200'000; ++i) views.Note(KeyNumber(i));
  int slices = 0;
  for (; slices < 1000 && !views.Filled(); ++slices) EXPECT_TRUE(views.Fill(1000));
  EXPECT_LE(slices, 70);
}

TEST_F(ViewCatalogTest, ForgetsARoute) {
  Put(1, 0, 10);
  Put(2, 0, 10);
  ViewCatalog views(*store_);
  FillAll(views);
  views.Forget(KeyNumber(1));
  EXPECT_THAT(AskFor(views, 15).places, IsEmpty());
  EXPECT_EQ(AskFor(views, 25).places.size(), 1U);
}

TEST_F(ViewCatalogTest, StopsAtItsBoundAndSaysWhatIsLeftOut) {
  for (unsigned route = 1; route <= 3; ++route) Put(route, 0, 10);
  ViewCatalog views(*store_, {.most_segments = 15});
  FillAll(views);
  views.Note(KeyNumber(1));
  EXPECT_TRUE(views.Filled());
  EXPECT_EQ(AskFor(views, 10).coverage, (route::ViewCoverage{15, 20, 1}));
}

TEST_F(ViewCatalogTest, ASegmentThatIsNoneIsLeftOutAndCounted) {
  Put(1, 0, 3);
  auto piece = route::MakePiece(KeyNumber(1), SegmentToSee(13, 3));
  piece.bytes = {1, 2, 3};
  piece.digest = route::Sha256(piece.bytes);
  ASSERT_TRUE(store_->AppendSegments({&piece, 1}));
  ViewCatalog views(*store_);
  const auto filled = views.Fill(100);
  ASSERT_FALSE(filled);
  EXPECT_EQ(filled.error().code, ErrorCode::kCorrupt);
  EXPECT_EQ(AskFor(views, 10).coverage, (route::ViewCoverage{3, 4, 0}));
  views.Note(KeyNumber(1));
  EXPECT_TRUE(views.Fill(100)) << "told once";
  EXPECT_EQ(views.Add(piece).error().code, ErrorCode::kCorrupt);
  EXPECT_THAT(views.TakeDamaged(), IsEmpty()) << "it is as it was sent";
}

TEST(ViewCatalogDamage, ThatAnAnswerMeetsIsToldAsWell) {
  route::SegmentPiece piece = route::MakePiece(KeyNumber(1), SegmentToSee(10, 0));
  piece.digest = test::ToyDigest(piece.bytes);
  test::MemoryStore store;
  ASSERT_TRUE(store.AppendSegments({&piece, 1}));
  ASSERT_TRUE(store.PutRoute(test::InfoOf(piece.key, {&piece, 1}, route::RouteState::kComplete)));
  ViewCatalog views(store);
  while (!views.Filled()) ASSERT_TRUE(views.Fill(5));
  EXPECT_THAT(views.TakeDamaged(), IsEmpty());
  store.damaged = {{piece.key, piece.index}};
  const auto reply =
      views.Answer({AgentId("robot"), 1, {.view = ViewOf(SegmentToSee(10, 0))}}, AgentId("server"));
  EXPECT_NE(reply.error, "");
  const auto damaged = views.TakeDamaged();
  ASSERT_EQ(damaged.size(), 1U);
  EXPECT_EQ(damaged[0].segment, piece.index);
}

TEST_F(ViewCatalogTest, GivesNoMorePlacesThanAskedFor) {
  for (unsigned route = 1; route <= 40; ++route) {
    std::vector<route::SegmentPiece> pieces{route::MakePiece(KeyNumber(route), SegmentToSee(7, 0))};
    ASSERT_TRUE(store_->AppendSegments(pieces));
    ASSERT_TRUE(
        store_->PutRoute(test::InfoOf(KeyNumber(route), pieces, route::RouteState::kTeaching)));
  }
  ViewCatalog views(*store_);
  FillAll(views);
  const route::View view = ViewOf(SegmentToSee(7, 0));
  EXPECT_EQ(Ask(views, {.view = view}).places.size(), exchange::kMaxPlacesPerReply);
  EXPECT_EQ(Ask(views, {.page_size = 3, .view = view}).places.size(), 3U);
}

TEST_F(ViewCatalogTest, AViewThatCannotBeAnsweredIsSaidByField) {
  ViewCatalog views(*store_);
  const route::View view = ViewOf(SegmentToSee(1, 0));
  route::View nowhere = view;
  nowhere[3].v_px = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THAT(Ask(views, {.view = route::View(route::kMaxViewFeatures + 1)}).error,
              HasSubstr("features in a view is 841"));
  EXPECT_THAT(Ask(views, {.view = nowhere}).error, HasSubstr("v in a view"));
  EXPECT_THAT(Ask(views, {.name = "yard", .view = view}).error,
              HasSubstr("name is given together with a view"));
  EXPECT_THAT(Ask(views, {.tags = {"wet"}, .view = view}).error, HasSubstr("tags is given"));
  EXPECT_THAT(Ask(views, {.cursor = "n/1", .view = view}).error, HasSubstr("cursor is given"));
}

TEST_F(ViewCatalogTest, ACatalogWithoutAnIndexSaysSo) {
  const exchange::CatalogRequest request{AgentId("robot"), 1, {.view = ViewOf(SegmentToSee(1, 0))}};
  EXPECT_THAT(Answer(request, AgentId("server"), *store_).error, HasSubstr("no index of views"));
}

}  // namespace
}  // namespace trailcast::catalog
