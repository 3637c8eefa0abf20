#include "services/route/route_ref.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace trailcast::route {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// An id that begins so.
std::string Id(const std::string& begins) { return begins + std::string(32 - begins.size(), '0'); }

RouteInfo Named(const std::string& name, const std::string& id, std::uint32_t revision = 1) {
  RouteInfo info;
  info.key = {RouteId(Id(id)), TeachingId(revision)};
  info.name = name;
  info.revision = RevisionNumber(revision);
  return info;
}

TEST(ParseRouteRef, TakesNamesIdsAndTheirRevisions) {
  EXPECT_EQ(ParseRouteRef("hall")->route, "hall");
  EXPECT_EQ(ParseRouteRef("hall")->revision, 0U);
  EXPECT_EQ(ParseRouteRef("a3f9c21@12")->route, "a3f9c21");
  EXPECT_EQ(ParseRouteRef("a3f9c21@12")->revision, 12U);
}

TEST(ParseRouteRef, SaysWhatWasExpected) {
  for (const char* text : {"", "@", "@2", "hall@", "hall@0", "hall@-1", "hall@2x", "hall@2@3",
                           "hall@99999999999", "the hall"}) {
    const auto ref = ParseRouteRef(text);
    ASSERT_FALSE(ref) << text;
    EXPECT_THAT(ref.error().message, HasSubstr("expected its name"));
  }
}

TEST(LooksLikeId, FromSevenHexadecimalDigitsOn) {
  EXPECT_TRUE(LooksLikeId("a3f9c21"));
  EXPECT_TRUE(LooksLikeId(Id("a")));
  EXPECT_FALSE(LooksLikeId("a3f9c2"));
  EXPECT_FALSE(LooksLikeId("A3F9C21"));
  EXPECT_FALSE(LooksLikeId("a3f9c21-hall"));
  EXPECT_FALSE(LooksLikeId(Id("a") + "0"));
}

TEST(OnlyMeant, FindsANameAndTheBeginningOfAnId) {
  const RouteInfo hall = Named("hall", "a3f9c21");
  const RouteInfo yard = Named("yard", "a3f9c22");
  EXPECT_THAT(OnlyMeant({hall, yard}, "hall"), ElementsAre(hall));
  EXPECT_THAT(OnlyMeant({hall, yard}, "a3f9c22"), ElementsAre(yard));
  EXPECT_THAT(OnlyMeant({hall, yard}, "a3f9c2"), IsEmpty()) << "six digits are a name";
}

TEST(OnlyMeant, ANameThatLooksLikeAnIdHidesNoRoute) {
  const RouteInfo hall = Named("hall", "a3f9c21");
  const RouteInfo named_so = Named("a3f9c21", "b");
  EXPECT_THAT(OnlyMeant({hall, named_so}, "a3f9c21"), ElementsAre(hall, named_so));
  const RouteInfo named_wholly_so = Named(Id("a3f9c21"), "b");
  EXPECT_THAT(OnlyMeant({hall, named_wholly_so}, Id("a3f9c21")), ElementsAre(hall));
}

TEST(ShortIds, HaveAsManyDigitsAsTellRoutesApart) {
  const std::vector<RouteInfo> apart{Named("hall", "a3f9c21"), Named("hall", "a3f9c21", 2),
                                     Named("yard", "b")};
  EXPECT_EQ(ShortIds(apart).Of(apart[1]), "a3f9c21@2");
  EXPECT_EQ(ShortIds(apart).Of(apart[2].key.route), "b000000");
  const std::vector<RouteInfo> alike{Named("hall", "a3f9c2155"), Named("yard", "a3f9c2156")};
  EXPECT_EQ(ShortIds(alike).Of(alike[0]), "a3f9c2155@1");
  EXPECT_EQ(ShortIds(alike).Of(alike[1]), "a3f9c2156@1");
  EXPECT_EQ(ShortIds().Of(Named("hall", "a3f9c21", 0)), "a3f9c21") << "no number yet";
}

}  // namespace
}  // namespace trailcast::route
