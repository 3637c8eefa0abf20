#include "services/fleet/routes/route_export.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/taught_route.h"

namespace trailcast::fleet {
namespace {

using test::TeachSamples;
using testing::HasSubstr;

exchange::CatalogReply ReplyOf(std::vector<route::RouteInfo> routes) {
  exchange::CatalogReply reply;
  reply.page.routes = std::move(routes);
  return reply;
}

route::RouteInfo Revision(std::uint32_t number, route::RouteState state) {
  route::RouteInfo info = TeachSamples(2).info;
  info.key.teaching = TeachingId(number);
  info.revision = RevisionNumber(number);
  info.taught_unix_ms += number;
  info.state = state;
  return info;
}

TEST(ChooseForExport, TakesTheNewestThatIsComplete) {
  const auto reply =
      ReplyOf({Revision(1, route::RouteState::kComplete), Revision(2, route::RouteState::kComplete),
               Revision(3, route::RouteState::kTeaching)});
  EXPECT_EQ(ChooseForExport(reply, "hall", {}, "it")->revision, RevisionNumber(2));
  EXPECT_EQ(ChooseForExport(reply, "hall", {.number = 1}, "it")->revision, RevisionNumber(1));
  EXPECT_THAT(ChooseForExport(reply, "hall", {.number = 3}, "it").error().message,
              HasSubstr("'hall' revision 3 is still being taught (2 segments so far)"));
  EXPECT_THAT(ChooseForExport(reply, "hall", {.number = 4}, "it").error().message,
              HasSubstr("it has no revision 4 of route 'hall'; it has 1, 2, 3"));
}

TEST(ChooseForExport, RefusesANameThatTwoScoutsGave) {
  route::RouteInfo other = Revision(1, route::RouteState::kComplete);
  other.key.route = RouteId(std::string(32, 'f'));
  other.scout = AgentId("scout-2");
  const auto reply = ReplyOf({Revision(1, route::RouteState::kComplete), other});
  const auto refused = ChooseForExport(reply, "hall", {}, "it");
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message,
              testing::AllOf(HasSubstr("'hall' may be any of 2 routes, give the id of one"),
                             HasSubstr("of scout 'scout-1'"),
                             HasSubstr("fffffff@1 'hall' of scout 'scout-2'")));
  EXPECT_EQ(ChooseForExport(reply, "hall", {.scout = "scout-2"}, "it").value(), other);
  EXPECT_EQ(ChooseForExport(reply, "fffffff", {}, "it").value(), other);
}

TEST(ChooseForExport, SaysThatATeachingWasCutOff) {
  route::RouteInfo cut_off = Revision(1, route::RouteState::kComplete);
  cut_off.cut_off = true;
  EXPECT_THAT(ChooseForExport(ReplyOf({cut_off}), "hall", {}, "it").error().message,
              testing::AllOf(HasSubstr("it has no active revision of route 'hall'; it has "),
                             HasSubstr("@1 (cut off): say which with --revision")));
}

TEST(ChooseForExport, NamesWhatThereIsInstead) {
  exchange::CatalogReply reply;
  reply.similar_names = {"hall", "hull"};
  EXPECT_EQ(ChooseForExport(reply, "hell", {}, "server 'barn'").error().message,
            "server 'barn' has no route 'hell'; did you mean 'hall' or 'hull'?");
  reply.similar_names = {"yard", "office"};
  EXPECT_EQ(ChooseForExport(reply, "hell", {}, "server 'barn'").error().message,
            "server 'barn' has no route 'hell'; there is yard, office");
  EXPECT_EQ(ChooseForExport({}, "hell", {.number = 2}, "server 'barn'").error().message,
            "server 'barn' has no route 'hell'");
}

TEST(ProgressText, EstimatesWhatIsLeft) {
  EXPECT_EQ(ProgressText("fetching 'hall'", 3'000'000, 12'000'000, std::chrono::seconds(5)),
            "fetching 'hall': 25 % of 12.0 MB, about 15 s left");
  EXPECT_EQ(ProgressText("fetching 'hall'", 0, 12'000'000, std::chrono::seconds(5)),
            "fetching 'hall': 0 % of 12.0 MB");
}

}  // namespace
}  // namespace trailcast::fleet
