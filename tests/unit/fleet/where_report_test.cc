#include "services/fleet/routes/where_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace trailcast::fleet {
namespace {

using testing::HasSubstr;

exchange::CatalogReply Reply() {
  exchange::CatalogReply reply;
  route::RouteInfo info;
  info.key = {RouteId("0123456789abcdef0123456789abcdef"), TeachingId(3)};
  info.revision = RevisionNumber(3);
  info.name = "aisle-3";
  info.segment_count = 18;
  info.state = route::RouteState::kComplete;
  info.standing = route::Standing::kActive;
  reply.page.routes = {info};
  reply.places = {{info.key, SegmentIndex(7), 0.625}};
  reply.coverage = {1200, 1200, 0};
  return reply;
}

TEST(WhereText, TellsRouteRevisionSegmentAndScore) {
  EXPECT_EQ(WhereText(Reply()), "route aisle-3 0123456@3, segment 7 of 18, score 0.62\n");
}

TEST(WhereText, SaysOfARevisionThatIsNotFollowedWhatItIs) {
  exchange::CatalogReply reply = Reply();
  reply.page.routes[0].standing = route::Standing::kRetired;
  EXPECT_EQ(WhereText(reply), "route aisle-3 0123456@3 (retired), segment 7 of 18, score 0.62\n");
  EXPECT_EQ(WhereJson(reply)["places"][0]["state"], "retired");
}

TEST(WhereText, SaysThatNoneLooksLikeThis) {
  exchange::CatalogReply reply;
  reply.coverage = {1200, 1200, 0};
  EXPECT_EQ(WhereText(reply), "none of the 1200 segments looks like this\n");
}

TEST(WhereText, SaysHowMuchWasNotSearched) {
  exchange::CatalogReply reply = Reply();
  reply.coverage = {1200, 3000, 5};
  EXPECT_THAT(WhereText(reply),
              HasSubstr("searched 1200 of 3000 segments, and none of 5 further routes\n"));
}

TEST(WhereText, APlaceWithoutItsRouteIsLeftOut) {
  exchange::CatalogReply reply = Reply();
  reply.places.push_back(reply.places[0]);
  EXPECT_EQ(WhereText(reply), WhereText(Reply()));
}

TEST(WhereJson, HasPlacesAndCoverage) {
  const std::string json = WhereJson(Reply()).dump();
  EXPECT_THAT(json, HasSubstr(R"("name":"aisle-3","route":"0123456789abcdef0123456789abcdef")"));
  EXPECT_THAT(json, HasSubstr(R"("segment":7,"segments":18,"score":0.625)"));
  EXPECT_THAT(json, HasSubstr(R"("segments_indexed":1200)"));
  EXPECT_EQ(WhereJson({})["places"].dump(), "[]");
}

}  // namespace
}  // namespace trailcast::fleet
