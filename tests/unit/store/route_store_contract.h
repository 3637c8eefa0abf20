#pragma once

// This is what every RouteStore promises. Include it in one source file per kind of store, and
// there INSTANTIATE_TEST_SUITE_P(<kind>, RouteStoreContract, testing::Values(&Make<kind>Home)).

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>

#include "services/store/route_store.h"
#include "tests/unit/store/pieces.h"

namespace trailcast::store {

// This is where a store lives: opened, closed and opened again it is the same store.
class StoreHome {
 public:
  StoreHome() = default;
  virtual ~StoreHome() = default;
  StoreHome(const StoreHome&) = delete;
  StoreHome& operator=(const StoreHome&) = delete;
  [[nodiscard]] virtual Result<std::unique_ptr<RouteStore>> Open() = 0;
};

class RouteStoreContract : public testing::TestWithParam<std::unique_ptr<StoreHome> (*)()> {
 protected:
  void SetUp() override { Reopen(); }
  void Reopen() {
    store_.reset();
    auto opened = home_->Open();
    ASSERT_TRUE(opened) << opened.error().message;
    store_ = std::move(*opened);
  }

  static ErrorCode CodeOf(const Result<void>& result) {
    EXPECT_FALSE(result) << "expected an error";
    return result ? ErrorCode::kInternal : result.error().code;
  }

  std::unique_ptr<StoreHome> home_ = GetParam()();
  std::unique_ptr<RouteStore> store_;
};

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST_P(RouteStoreContract, NewStoreIsEmptyAndWhole) {
  EXPECT_THAT(store_->ListRoutes().value(), IsEmpty());
  EXPECT_THAT(store_->HeldSegments(kYard).value(), IsEmpty());
  EXPECT_THAT(store_->UnreceiptedSegments(kYard).value(), IsEmpty());
  EXPECT_EQ(store_->FindRoute(kYard).value(), std::nullopt);
  EXPECT_THAT(store_->Verify().value(), IsEmpty());
}

TEST_P(RouteStoreContract, SegmentsComeBackByteForByteAlsoAfterReopening) {
  ASSERT_TRUE(store_->AppendSegments(Pieces({0, 1, 4})));
  for (int round = 0; round < 2; ++round) {
    EXPECT_EQ(store_->ReadSegment(kYard, SegmentIndex(4)).value(), Piece(4));
    EXPECT_EQ(store_->HeldSegments(kYard).value(), Indices({0, 1, 4}));
    Reopen();
  }
}

TEST_P(RouteStoreContract, LargestAndSmallestPiecesAreHeld) {
  const std::vector pieces{Piece(0, 0, 1), Piece(4294967295U, 0, 1U << 20U)};
  ASSERT_TRUE(store_->AppendSegments(pieces));
  EXPECT_EQ(store_->ReadSegment(kYard, SegmentIndex(0)).value(), pieces[0]);
  EXPECT_EQ(store_->ReadSegment(kYard, SegmentIndex(4294967295U)).value(), pieces[1]);
}

TEST_P(RouteStoreContract, RevisionsOfARouteAreApart) {
  route::SegmentPiece other = Piece(0, 99);
  other.key.teaching = TeachingId(2);
  ASSERT_TRUE(store_->AppendSegments(Pieces({0})));
  ASSERT_TRUE(store_->AppendSegments({&other, 1}));
  EXPECT_EQ(store_->ReadSegment(kYard, SegmentIndex(0)).value(), Piece(0));
  EXPECT_EQ(store_->ReadSegment(other.key, SegmentIndex(0)).value(), other);
}

TEST_P(RouteStoreContract, SegmentNotHeldIsNotFound) {
  ASSERT_TRUE(store_->AppendSegments(Pieces({0})));
  const auto read = store_->ReadSegment(kYard, SegmentIndex(1));
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().code, ErrorCode::kNotFound);
  EXPECT_THAT(read.error().message,
              HasSubstr("segment 1 of teaching 1 of route " + kYard.route.value()));
}

TEST_P(RouteStoreContract, AppendingWhatIsHeldIsFine) {
  ASSERT_TRUE(store_->AppendSegments(Pieces({0, 1})));
  EXPECT_TRUE(store_->AppendSegments(Pieces({1, 2, 2})));
  EXPECT_EQ(store_->HeldSegments(kYard).value(), Indices({0, 1, 2}));
}

TEST_P(RouteStoreContract, OtherBytesForAHeldSegmentAreAConflictAndNothingOfTheBatchIsKept) {
  ASSERT_TRUE(store_->AppendSegments(Pieces({1})));
  EXPECT_EQ(CodeOf(store_->AppendSegments(std::vector{Piece(0), Piece(1, 7)})),
            ErrorCode::kConflict);
  EXPECT_EQ(store_->HeldSegments(kYard).value(), Indices({1}));
  EXPECT_EQ(store_->ReadSegment(kYard, SegmentIndex(1)).value(), Piece(1));
}

TEST_P(RouteStoreContract, PieceThatFailsItsDigestIsRefusedWithItsBatch) {
  std::vector pieces = Pieces({0, 1});
  pieces[1].bytes[17] ^= 4U;
  EXPECT_EQ(CodeOf(store_->AppendSegments(pieces)), ErrorCode::kCorrupt);
  EXPECT_THAT(store_->HeldSegments(kYard).value(), IsEmpty());
}

TEST_P(RouteStoreContract, PieceThatNoSegmentCanBeIsRefused) {
  EXPECT_EQ(CodeOf(store_->AppendSegments(std::vector{Piece(0, 0, 0)})), ErrorCode::kCorrupt);
  EXPECT_EQ(CodeOf(store_->AppendSegments(std::vector{Piece(0, 0, (1U << 20U) + 1)})),
            ErrorCode::kCorrupt);
  route::SegmentPiece nameless = Piece(0);
  nameless.key.route = RouteId("");
  EXPECT_EQ(CodeOf(store_->AppendSegments({&nameless, 1})), ErrorCode::kInvalidArgument);
}

TEST_P(RouteStoreContract, RouteComesBackWithEveryFieldAlsoAfterReopening) {
  ASSERT_TRUE(store_->PutRoute(Complete(3)));
  Reopen();
  EXPECT_EQ(store_->FindRoute(kYard).value(), Complete(3));
  EXPECT_THAT(store_->ListRoutes().value(), ElementsAre(Complete(3)));
}

TEST_P(RouteStoreContract, NewsReplacesWhatWasKnownAndOldNewsIsIgnored) {
  ASSERT_TRUE(store_->PutRoute(Teaching(2)));
  ASSERT_TRUE(store_->PutRoute(Teaching(5)));
  ASSERT_TRUE(store_->PutRoute(Teaching(3)));
  EXPECT_EQ(store_->FindRoute(kYard).value(), Teaching(5));
  ASSERT_TRUE(store_->PutRoute(Complete(5)));
  EXPECT_EQ(store_->FindRoute(kYard).value(), Complete(5));
}

TEST_P(RouteStoreContract, CompleteRouteNeverChanges) {
  ASSERT_TRUE(store_->PutRoute(Complete(5)));
  EXPECT_TRUE(store_->PutRoute(Complete(5)));
  EXPECT_TRUE(store_->PutRoute(Teaching(5))) << "overtaken by its own completion";
  EXPECT_EQ(CodeOf(store_->PutRoute(Complete(6))), ErrorCode::kConflict);
  EXPECT_EQ(CodeOf(store_->PutRoute(Complete(4))), ErrorCode::kConflict);
  EXPECT_EQ(CodeOf(store_->PutRoute(Teaching(6))), ErrorCode::kConflict);
  route::RouteInfo renamed = Complete(5);
  renamed.name = "garden";
  EXPECT_TRUE(store_->PutRoute(renamed)) << "another server's label of the same edition";
  EXPECT_EQ(store_->FindRoute(kYard).value(), Complete(5)) << "of which one counts";
}

route::RouteInfo Labelled(route::RouteInfo info, const std::string& name, route::Standing standing,
                          std::uint32_t edition) {
  info.name = name;
  info.description = "past the greenhouse";
  info.standing = standing;
  info.edition = edition;
  return info;
}

TEST_P(RouteStoreContract, LabelsOfACompleteRouteChangeWithALaterEdition) {
  using route::Standing;
  ASSERT_TRUE(store_->PutRoute(Complete(5)));
  const route::RouteInfo second = Labelled(Complete(5), "garden", Standing::kActive, 2);
  ASSERT_TRUE(store_->PutRoute(second));
  EXPECT_TRUE(store_->PutRoute(Complete(5))) << "as taught: old news of its labels";
  EXPECT_TRUE(store_->PutRoute(Labelled(Complete(5), "park", Standing::kRetired, 1)));
  EXPECT_EQ(CodeOf(store_->PutRoute(Labelled(Complete(6), "park", Standing::kActive, 3))),
            ErrorCode::kConflict);
  Reopen();
  EXPECT_EQ(store_->FindRoute(kYard).value(), second);
  EXPECT_EQ(store_->QueryRoutes({.standing = Standing::kActive}).value().total, 1U);
  EXPECT_EQ(store_->QueryRoutes({.standing = Standing::kStaged}).value().total, 0U);
}

TEST_P(RouteStoreContract, RevisionsOfARouteRise) {
  for (const std::uint32_t revision : {3U, 1U, 2U}) {
    route::RouteInfo info = Complete(2);
    info.key.teaching = TeachingId(10 - revision);
    info.revision = RevisionNumber(revision);
    ASSERT_TRUE(store_->PutRoute(info));
  }
  std::vector<std::uint32_t> revisions;
  const std::vector<route::RouteInfo> found = store_->FindRevisions(kYard.route).value();
  for (const route::RouteInfo& info : found) revisions.push_back(info.revision.value());
  EXPECT_THAT(revisions, testing::ElementsAre(1U, 2U, 3U));
}

TEST_P(RouteStoreContract, ATombstoneTakesTheSegmentsAndLateOnesAreRefused) {
  ASSERT_TRUE(store_->AppendSegments(Pieces({0, 1})));
  ASSERT_TRUE(store_->PutRoute(Teaching(2)));
  const route::RouteInfo tombstone = Labelled(Teaching(2), "yard", route::Standing::kDeleted, 1);
  ASSERT_TRUE(store_->PutRoute(tombstone));
  EXPECT_EQ(CodeOf(store_->AppendSegments(Pieces({2}))), ErrorCode::kConflict);
  EXPECT_TRUE(store_->PutRoute(Complete(3))) << "late news";
  Reopen();
  EXPECT_EQ(store_->FindRoute(kYard).value(), tombstone);
  EXPECT_THAT(store_->HeldSegments(kYard).value(), testing::IsEmpty());
  EXPECT_THAT(store_->ListRoutes().value(), testing::IsEmpty());
  EXPECT_THAT(store_->FindRoutesByName("yard").value(), testing::IsEmpty());
  EXPECT_THAT(store_->FindRevisions(kYard.route).value(), testing::IsEmpty());
  EXPECT_EQ(store_->QueryRoutes({}).value().total, 0U);
  EXPECT_EQ(CodeOf(store_->AppendSegments(Pieces({2}))), ErrorCode::kConflict);
  EXPECT_THAT(store_->Verify().value(), testing::IsEmpty());
}

TEST_P(RouteStoreContract, DigestsOfWhatIsHeldAreToldByIndex) {
  ASSERT_TRUE(store_->AppendSegments(Pieces({0, 2})));
  const auto held = store_->SegmentDigests(kYard).value();
  ASSERT_EQ(held.size(), 2U);
  EXPECT_EQ(held[0].index, SegmentIndex(0));
  EXPECT_EQ(held[0].digest, Piece(0).digest);
  EXPECT_EQ(held[1].index, SegmentIndex(2));
  EXPECT_EQ(held[1].digest, Piece(2).digest);
}

TEST_P(RouteStoreContract, TeachingsAreKnownAlsoWhenDeletedAndSinceWhenByThisClock) {
  route::RouteInfo info = Teaching(3);
  info.taught_unix_ms = 1'670'000'000'000;  // a scout whose clock says 2022
  info.revision = RevisionNumber(4);
  ASSERT_TRUE(store_->PutRoute(info));
  const auto before = store_->FindTeachings(kYard.route).value();
  ASSERT_EQ(before.size(), 1U);
  EXPECT_EQ(before[0].teaching, kYard.teaching);
  EXPECT_EQ(before[0].revision, RevisionNumber(4));
  EXPECT_GT(before[0].grown_unix_ms, 1'780'000'000'000);
  info.description = "past the greenhouse";
  info.edition = 1;
  ASSERT_TRUE(store_->PutRoute(info));
  EXPECT_EQ(store_->FindTeachings(kYard.route).value()[0].grown_unix_ms, before[0].grown_unix_ms)
      << "labels are no growth";
  info.standing = route::Standing::kDeleted;
  info.edition = 2;
  ASSERT_TRUE(store_->PutRoute(info));
  EXPECT_EQ(store_->FindTeachings(kYard.route).value().at(0).revision, RevisionNumber(4));
}

TEST_P(RouteStoreContract, RoutesAreFoundByHowTheirIdsBeginDeletedOnesToo) {
  const auto put = [&](const char* begin, std::uint64_t teaching, route::Standing standing) {
    route::RouteInfo info = Teaching(3);
    info.key = {RouteId(begin + std::string(28, '0')), TeachingId(teaching)};
    info.standing = standing;
    EXPECT_TRUE(store_->PutRoute(info));
    return info;
  };
  const std::vector<route::RouteInfo> infos = {
      put("a3f0", 7, route::Standing::kDeleted), put("a3f9", 1, route::Standing::kDeleted),
      put("a3f9", 2, route::Standing::kStaged), put("a3ff", 1, route::Standing::kActive),
      put("a400", 1, route::Standing::kStaged)};
  const auto found = [&](const std::string& prefix) {
    return store_->FindRoutesWithin(prefix).value();
  };
  EXPECT_EQ(found(""), infos);
  EXPECT_EQ(found("a3"), (std::vector{infos[0], infos[1], infos[2], infos[3]}));
  EXPECT_EQ(found("a3f9"), (std::vector{infos[1], infos[2]}));
  EXPECT_TRUE(found("a2").empty());
  EXPECT_TRUE(found("ff").empty());
}

// This is a revision that has segments of another one in it.
TEST_P(RouteStoreContract, SegmentsThatAreAlikeOutliveEachOther) {
  route::SegmentPiece again = Piece(0);
  again.key.teaching = TeachingId(2);
  again.index = SegmentIndex(5);
  EXPECT_EQ(store_->FindContent(again.digest).value(), std::nullopt);
  ASSERT_TRUE(store_->AppendSegments(Pieces({0, 1})));
  ASSERT_TRUE(store_->AppendSegments({&again, 1}));
  EXPECT_EQ(store_->FindContent(again.digest).value(), again.bytes);
  ASSERT_TRUE(store_->PutRoute(Labelled(Teaching(2), "yard", route::Standing::kDeleted, 1)));
  Reopen();
  EXPECT_EQ(store_->ReadSegment(again.key, again.index).value(), again);
  EXPECT_EQ(store_->FindContent(again.digest).value(), again.bytes);
  EXPECT_EQ(store_->FindContent(Piece(1).digest).value(), std::nullopt);
  EXPECT_THAT(store_->Verify().value(), testing::IsEmpty());
}

TEST_P(RouteStoreContract, DroppedSegmentsAreGoneAndTheirRouteAndWhatOthersHaveOfThemStay) {
  route::SegmentPiece again = Piece(0);
  again.key.teaching = TeachingId(2);
  ASSERT_TRUE(store_->AppendSegments(Pieces({0, 1})));
  ASSERT_TRUE(store_->AppendSegments({&again, 1}));
  ASSERT_TRUE(store_->PutRoute(Complete(2)));
  ASSERT_TRUE(store_->DropSegments(kYard));
  Reopen();
  EXPECT_THAT(store_->HeldSegments(kYard).value(), IsEmpty());
  EXPECT_EQ(store_->FindRoute(kYard).value(), Complete(2));
  EXPECT_EQ(store_->ReadSegment(again.key, again.index).value(), again);
  EXPECT_EQ(store_->FindContent(Piece(1).digest).value(), std::nullopt);
  const route::SegmentPiece other = Piece(0, 5);
  EXPECT_TRUE(store_->AppendSegments({&other, 1})) << "with other bytes too";
  EXPECT_TRUE(store_->DropSegments({RouteId("nowhere"), TeachingId(1)}));
}

TEST_P(RouteStoreContract, TeachingsWithSegmentsAreListedByKeyKnownOrNot) {
  std::vector<route::SegmentPiece> pieces = Pieces({0, 1, 2, 0, 0});
  pieces[3].key.teaching = TeachingId(2);
  pieces[4].key.route = RouteId("f" + kYard.route.value().substr(1));
  ASSERT_TRUE(store_->AppendSegments(pieces));
  ASSERT_TRUE(store_->PutRoute(Teaching(3)));
  const auto list = [&](const route::RouteKey& after, std::size_t most) {
    std::vector<std::string> listed;
    const std::vector<HeldTeaching> held = store_->ListHeld(after, most).value();
    for (const HeldTeaching& each : held) {
      listed.push_back(fmt::format("{}/{} {}{}", each.key.route.value().substr(0, 2),
                                   each.key.teaching.value(), each.segments,
                                   each.known ? " known" : ""));
    }
    return listed;
  };
  const route::RouteKey before_all{RouteId(), TeachingId()};
  EXPECT_THAT(list(before_all, 10), ElementsAre("01/1 3 known", "01/2 1", "f1/1 1"));
  EXPECT_THAT(list(before_all, 1), ElementsAre("01/1 3 known"));
  EXPECT_THAT(list(kYard, 10), ElementsAre("01/2 1", "f1/1 1"));
  EXPECT_THAT(list(pieces[4].key, 10), IsEmpty());
}

TEST_P(RouteStoreContract, ImpossibleRoutesAreRefusedNamingTheField) {
  const auto message = [this](auto&& spoil) {
    route::RouteInfo info = Complete(1);
    spoil(info);
    const Result<void> put = store_->PutRoute(info);
    EXPECT_EQ(CodeOf(put), ErrorCode::kInvalidArgument);
    return put ? "" : put.error().message;
  };
  EXPECT_THAT(message([](auto& i) { i.name = "my yard"; }),
              HasSubstr("route name \"my yard\" is not"));
  EXPECT_THAT(message([](auto& i) { i.key.route = RouteId("'"); }),
              HasSubstr("route id \"'\" is not"));
  EXPECT_THAT(message([](auto& i) { i.scout = AgentId(""); }), HasSubstr("scout \"\" is not"));
  EXPECT_THAT(message([](auto& i) { i.camera.assign(129, 'x'); }),
              HasSubstr("camera is not one line"));
  EXPECT_THAT(message([](auto& i) { i.image_width_px = -1; }),
              HasSubstr("image width is -1, expected 0 to 65535"));
  EXPECT_THAT(message([](auto& i) { i.length_m = 0.0 / (i.length_m - 2.5); }),
              HasSubstr("route length in metres is"));
  EXPECT_THAT(store_->ListRoutes().value(), IsEmpty());
}

TEST_P(RouteStoreContract, RoutesAreListedNewestFirstAndFoundByExactName) {
  const auto put = [this](char digit, const std::string& name, std::int64_t taught_unix_ms) {
    route::RouteInfo info = Complete(1);
    info.key.route = RouteId(std::string(32, digit));
    info.name = name;
    info.taught_unix_ms = taught_unix_ms;
    EXPECT_TRUE(store_->PutRoute(info));
    return info;
  };
  const auto old = put('c', "yard", 1000);
  const auto recent = put('a', "yard", 3000);
  const auto other = put('b', "Yard", 2000);
  EXPECT_THAT(store_->ListRoutes().value(), ElementsAre(recent, other, old));
  EXPECT_THAT(store_->FindRoutesByName("yard").value(), ElementsAre(recent, old));
  EXPECT_THAT(store_->FindRoutesByName("yar%").value(), IsEmpty());
  EXPECT_THAT(store_->FindRoutesByName("").value(), IsEmpty());
}

TEST_P(RouteStoreContract, ReceiptsAreRememberedPerSegmentAlsoAfterReopening) {
  ASSERT_TRUE(store_->AppendSegments(Pieces({0, 1, 2, 3})));
  EXPECT_EQ(store_->UnreceiptedSegments(kYard).value(), Indices({0, 1, 2, 3}));
  ASSERT_TRUE(store_->MarkReceipted(kYard, Indices({2, 0, 77})));  // 77 is not held: no matter
  ASSERT_TRUE(store_->MarkReceipted(kYard, Indices({0})));
  Reopen();
  EXPECT_EQ(store_->UnreceiptedSegments(kYard).value(), Indices({1, 3}));
  ASSERT_TRUE(store_->AppendSegments(Pieces({0, 4})));
  EXPECT_EQ(store_->UnreceiptedSegments(kYard).value(), Indices({1, 3, 4}));
}

TEST_P(RouteStoreContract, WhatWasFetchedIsStoredLikeTheRestAndCountsAsReceipted) {
  ASSERT_TRUE(store_->AppendSegments(Pieces({0})));
  ASSERT_TRUE(store_->AppendFetched(Pieces({0, 1, 2})));
  EXPECT_EQ(CodeOf(store_->AppendFetched(std::vector{Piece(3), Piece(1, 7)})),
            ErrorCode::kConflict);
  Reopen();
  EXPECT_EQ(store_->HeldSegments(kYard).value(), Indices({0, 1, 2}));
  EXPECT_EQ(store_->ReadSegment(kYard, SegmentIndex(2)).value(), Piece(2));
  EXPECT_THAT(store_->UnreceiptedSegments(kYard).value(), IsEmpty());
}

TEST_P(RouteStoreContract, VerifyFindsACompleteRouteOfOtherSegments) {
  ASSERT_TRUE(store_->AppendSegments(std::vector{Piece(0), Piece(1, 5)}));
  ASSERT_TRUE(store_->PutRoute(Complete(2)));
  EXPECT_THAT(store_->Verify().value(), ElementsAre(HasSubstr("not those its scout announced")));
}

}  // namespace trailcast::store
