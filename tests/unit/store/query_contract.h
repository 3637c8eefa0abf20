#pragma once

// This is the catalog's part of what every RouteStore promises; see route_store_contract.h.

#include <algorithm>
#include <string>
#include <vector>

#include "tests/unit/store/route_store_contract.h"

namespace trailcast::store {

class RouteQueryContract : public RouteStoreContract {
 protected:
  // This is the n-th route, taught at second n, n metres long.
  route::RouteInfo Put(std::uint32_t n, const std::string& name, std::vector<std::string> tags = {},
                       std::optional<route::Place> place = {}) {
    route::RouteInfo info = Complete(1);
    info.key.route = RouteId(fmt::format("{:032x}", 1000 + n));
    info.name = name;
    info.taught_unix_ms = 1000LL * n;
    info.length_m = n;
    info.tags = std::move(tags);
    info.place = place;
    EXPECT_TRUE(store_->PutRoute(info));
    return info;
  }
  std::vector<std::string> Names(const route::RouteQuery& query) {
    const auto page = store_->QueryRoutes(query);
    EXPECT_TRUE(page) << page.error().message;
    std::vector<std::string> names;
    if (!page) return names;
    for (const route::RouteInfo& info : page->routes) names.push_back(info.name);
    EXPECT_EQ(page->total, names.size());
    EXPECT_EQ(page->next, "");
    return names;
  }
};

TEST_P(RouteQueryContract, TagsAndPlaceComeBackAndGoWithWhatReplacesThem) {
  route::RouteInfo info = Teaching(2);
  info.tags = {"night", "wet"};
  info.place = {route::Place::Frame::kSite, 1.25, -2.5};
  ASSERT_TRUE(store_->PutRoute(info));
  Reopen();
  EXPECT_EQ(store_->FindRoute(kYard).value(), info);
  info.segment_count = 3;
  info.tags = {"day"};
  info.edition = 1;
  info.place.reset();
  ASSERT_TRUE(store_->PutRoute(info));
  EXPECT_EQ(store_->FindRoute(kYard).value(), info);
  EXPECT_THAT(Names({.tags = {"day"}}), ElementsAre("yard"));
  EXPECT_THAT(Names({.tags = {"wet"}}), IsEmpty());
  EXPECT_THAT(Names({.near = route::Surroundings{{}, 100.0}}), IsEmpty());
}

TEST_P(RouteQueryContract, UnsortedTagsAndPlacesNowhereAreRefused) {
  route::RouteInfo info = Teaching(1);
  info.tags = {"wet", "night"};
  EXPECT_EQ(CodeOf(store_->PutRoute(info)), ErrorCode::kInvalidArgument);
  info.tags = {"wet", "wet"};
  EXPECT_EQ(CodeOf(store_->PutRoute(info)), ErrorCode::kInvalidArgument);
  info.tags = {};
  info.place = {route::Place::Frame::kSite, 0.0, 0.0 / (info.length_m - 2.5)};
  EXPECT_EQ(CodeOf(store_->PutRoute(info)), ErrorCode::kInvalidArgument);
}

TEST_P(RouteQueryContract, ANameMayBeTheBeginningOfAnId) {
  route::RouteInfo info = Put(1, "barn");
  for (const char* id : {"a3f9c21", "a3f9c219", "a3f9c22", "a3f9c2f"}) {
    info.key.route = RouteId(id + std::string(32 - std::string_view(id).size(), '7'));
    info.name = "of-" + std::string(id);
    ASSERT_TRUE(store_->PutRoute(info));
  }
  info = Put(2, "a3f9c21");
  EXPECT_THAT(Names({.name = "a3f9c21"}), ElementsAre("a3f9c21", "of-a3f9c219", "of-a3f9c21"));
  EXPECT_THAT(Names({.name = "a3f9c2f"}), ElementsAre("of-a3f9c2f"));
  EXPECT_THAT(Names({.name = "a3f9c2"}), IsEmpty()) << "too little of an id";
  EXPECT_THAT(Names({.name = "a3f9c21", .scout = "nobody"}), IsEmpty());
  EXPECT_EQ(store_->FindMeant(info.key.route.value()).value(), std::vector{info});
  EXPECT_EQ(store_->FindMeant("a3f9c21").value().size(), 3U);
}

TEST_P(RouteQueryContract, EachFieldNarrowsDownAndAllMustHold) {
  Put(1, "barn-1", {"day", "wet"});
  Put(2, "barn-2", {"wet"});
  Put(3, "bar", {});
  Put(4, "yard", {"day"});
  EXPECT_THAT(Names({}), ElementsAre("yard", "bar", "barn-2", "barn-1"));
  EXPECT_THAT(Names({.name = "bar"}), ElementsAre("bar"));
  EXPECT_THAT(Names({.name_prefix = "barn"}), ElementsAre("barn-2", "barn-1"));
  EXPECT_THAT(Names({.name_prefix = "%"}), IsEmpty());
  EXPECT_THAT(Names({.tags = {"wet"}}), ElementsAre("barn-2", "barn-1"));
  EXPECT_THAT(Names({.tags = {"wet", "day"}}), ElementsAre("barn-1"));
  EXPECT_THAT(Names({.scout = "scout-1"}).size(), 4U);
  EXPECT_THAT(Names({.scout = "scout"}), IsEmpty());
  EXPECT_THAT(Names({.camera_prefix = "webcam"}).size(), 4U);
  EXPECT_THAT(Names({.camera_prefix = "omni"}), IsEmpty());
  EXPECT_THAT(Names({.min_length_m = 2.0, .max_length_m = 3.0}), ElementsAre("bar", "barn-2"));
  EXPECT_THAT(Names({.taught_from_unix_ms = 3000}), ElementsAre("yard", "bar"));
  EXPECT_THAT(Names({.taught_until_unix_ms = 3000}), ElementsAre("barn-2", "barn-1"));
  EXPECT_THAT(Names({.state = route::RouteState::kComplete}).size(), 4U);
  EXPECT_THAT(Names({.state = route::RouteState::kTeaching}), IsEmpty());
  EXPECT_THAT(Names({.name_prefix = "barn", .tags = {"day"}}), ElementsAre("barn-1"));
}

TEST_P(RouteQueryContract, SortsInEveryOrder) {
  Put(2, "b");
  Put(1, "c");
  Put(3, "a");
  using route::RouteOrder;
  EXPECT_THAT(Names({.order = RouteOrder::kNewest}), ElementsAre("a", "b", "c"));
  EXPECT_THAT(Names({.order = RouteOrder::kOldest}), ElementsAre("c", "b", "a"));
  EXPECT_THAT(Names({.order = RouteOrder::kName}), ElementsAre("a", "b", "c"));
  EXPECT_THAT(Names({.order = RouteOrder::kLongest}), ElementsAre("a", "b", "c"));
  EXPECT_THAT(Names({.order = RouteOrder::kShortest}), ElementsAre("c", "b", "a"));
}

TEST_P(RouteQueryContract, FindsWhatBeginsNear) {
  using Frame = route::Place::Frame;
  const auto near = [](Frame frame, double x, double y, double radius_m) {
    return route::RouteQuery{.near = route::Surroundings{{frame, x, y}, radius_m},
                             .order = route::RouteOrder::kName};
  };
  Put(1, "site", {}, route::Place{Frame::kSite, 100.0, 50.0});
  Put(2, "corner", {}, route::Place{Frame::kSite, 107.0, 57.0});  // 9.9 m further on
  Put(3, "munich", {}, route::Place{Frame::kWgs84, 11.5755, 48.1374});
  Put(4, "nowhere");
  EXPECT_THAT(Names(near(Frame::kSite, 100.0, 50.0, 0.001)), ElementsAre("site"));
  EXPECT_THAT(Names(near(Frame::kSite, 100.0, 50.0, 9.5)), ElementsAre("site"));
  EXPECT_THAT(Names(near(Frame::kSite, 100.0, 50.0, 10.0)), ElementsAre("corner", "site"));
  EXPECT_THAT(Names(near(Frame::kWgs84, 100.0, 50.0, 1e6)), IsEmpty());
  // 0.001 degrees further east there are 74.2 m, further north 111.2 m.
  EXPECT_THAT(Names(near(Frame::kWgs84, 11.5765, 48.1374, 75.0)), ElementsAre("munich"));
  EXPECT_THAT(Names(near(Frame::kWgs84, 11.5765, 48.1374, 73.0)), IsEmpty());
  EXPECT_THAT(Names(near(Frame::kWgs84, 11.5755, 48.1384, 112.0)), ElementsAre("munich"));
  EXPECT_THAT(Names(near(Frame::kWgs84, 11.5755, 48.1384, 110.0)), IsEmpty());
}

TEST_P(RouteQueryContract, PagesNeitherRepeatNorSkipWhateverIsStoredMeanwhile) {
  for (const auto order :
       {route::RouteOrder::kNewest, route::RouteOrder::kOldest, route::RouteOrder::kName,
        route::RouteOrder::kLongest, route::RouteOrder::kShortest}) {
    for (std::uint32_t n = 10; n < 20; ++n) Put(n, fmt::format("r-{}", n / 3));
    std::vector<route::RouteInfo> seen;
    route::RouteQuery query{.order = order, .page_size = 3};
    do {
      const auto page = store_->QueryRoutes(query);
      ASSERT_TRUE(page) << page.error().message;
      EXPECT_GE(page->total, 10U);
      EXPECT_LE(page->routes.size(), 3U);
      seen.insert(seen.end(), page->routes.begin(), page->routes.end());
      query.cursor = page->next;
      Put(5, "a-first");
      Put(50, "z-last");
    } while (!query.cursor.empty());
    std::erase_if(seen, [](const auto& info) { return info.name[0] != 'r'; });
    EXPECT_EQ(seen.size(), 10U);
    std::sort(seen.begin(), seen.end(), [](const auto& a, const auto& b) { return a.key < b.key; });
    EXPECT_EQ(std::unique(seen.begin(), seen.end()), seen.end());
  }
}

TEST_P(RouteQueryContract, ACursorOfNoPageIsRefused) {
  Put(1, "a");
  for (const char* cursor : {"?", "n/1/x", "n/1.5/x/1", "n//x/1", "a/a/x/1", "n/1/x/-1"}) {
    const auto page = store_->QueryRoutes({.cursor = cursor});
    ASSERT_FALSE(page) << cursor;
    EXPECT_EQ(page.error().code, ErrorCode::kInvalidArgument);
    EXPECT_THAT(page.error().message, HasSubstr("cursor"));
  }
}

TEST_P(RouteQueryContract, NamesNearAreThoseNextInTheAlphabet) {
  for (std::uint32_t n = 0; n < 9; ++n) Put(n, std::string(1, static_cast<char>('a' + n)));
  Put(20, "e");
  EXPECT_THAT(store_->NamesNear("e", 2).value(), ElementsAre("e", "f", "d", "c"));
  EXPECT_THAT(store_->NamesNear("zz", 2).value(), ElementsAre("i", "h"));
}

}  // namespace trailcast::store
