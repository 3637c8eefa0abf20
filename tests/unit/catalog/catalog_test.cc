#include "services/catalog/catalog.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <limits>

#include "tests/support/temp_dir.h"

namespace trailcast::catalog {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class Catalog : public testing::Test {
 protected:
  void SetUp() override { Open(); }
  void Open() { store_ = store::OpenSqliteStore(file_).value(); }

  route::RouteInfo Put(const std::string& name, std::int64_t taught_unix_ms) {
    route::RouteInfo info;
    info.key = {RouteId(fmt::format("{:032x}", taught_unix_ms)), TeachingId(1)};
    info.name = name;
    info.scout = AgentId("scout-1");
    info.taught_unix_ms = taught_unix_ms;
    EXPECT_TRUE(store_->PutRoute(info));
    return info;
  }
  exchange::CatalogReply Ask(const std::string& name) {
    return Answer({AgentId("follower-3"), 77, {.name = name}}, AgentId("server-1"), *store_);
  }

  test::TempDir dir_;
  const std::filesystem::path file_ = dir_ / "routes.db";
  std::unique_ptr<store::RouteStore> store_;
};

TEST_F(Catalog, ReplyIsAddressedToWhoAsked) {
  const exchange::CatalogReply reply = Ask("");
  EXPECT_EQ(reply.server, AgentId("server-1"));
  EXPECT_EQ(reply.client, AgentId("follower-3"));
  EXPECT_EQ(reply.request, 77U);
}

TEST_F(Catalog, NoNameAsksForEveryRouteNewestFirst) {
  const auto first = Put("yard", 1000);
  const auto third = Put("road", 3000);
  const auto second = Put("yard", 2000);
  EXPECT_THAT(Ask("").page.routes, ElementsAre(third, second, first));
  EXPECT_THAT(Ask("").similar_names, IsEmpty());
}

TEST_F(Catalog, NameFindsItsRoutesNewestFirst) {
  const auto first = Put("yard", 1000);
  Put("yard-2", 3000);
  const auto second = Put("yard", 2000);
  const exchange::CatalogReply reply = Ask("yard");
  EXPECT_THAT(reply.page.routes, ElementsAre(second, first));
  EXPECT_THAT(reply.similar_names, IsEmpty());
  EXPECT_EQ(reply.error, "");
}

TEST_F(Catalog, NameThatNoRouteHasBringsThoseThatExistNearestFirst) {
  Put("bookshop", 1000);
  Put("Yard", 2000);
  Put("Yard", 3000);
  const exchange::CatalogReply reply = Ask("yarrd");
  EXPECT_THAT(reply.page.routes, IsEmpty());
  EXPECT_THAT(reply.similar_names, ElementsAre("Yard", "bookshop"));
  EXPECT_EQ(reply.error, "");
}

TEST_F(Catalog, AtMostTenNamesAreSuggested) {
  for (int i = 0; i < 15; ++i) Put(fmt::format("route-{}", i), 1000 + i);
  EXPECT_EQ(Ask("path").similar_names.size(), 10U);
}

TEST_F(Catalog, EmptyCatalogAnswersWithNothing) {
  for (const char* name : {"", "yard"}) {
    const exchange::CatalogReply reply = Ask(name);
    EXPECT_THAT(reply.page.routes, IsEmpty());
    EXPECT_THAT(reply.similar_names, IsEmpty());
    EXPECT_EQ(reply.error, "");
  }
}

TEST_F(Catalog, NameThatNoRouteCanHaveIsAnErrorNamingTheField) {
  for (const std::string& name : {std::string("my yard"), std::string(65, 'x')}) {
    const exchange::CatalogReply reply = Ask(name);
    EXPECT_THAT(reply.error, HasSubstr("name \"" + name + "\" is not a name: 1 to 64 of"));
    EXPECT_THAT(reply.page.routes, IsEmpty());
  }
}

TEST_F(Catalog, WhatIsWrongWithAQueryIsSaidByField) {
  const auto error_of = [this](const route::RouteQuery& query) {
    const auto reply = Answer({AgentId("follower-3"), 77, query}, AgentId("server-1"), *store_);
    EXPECT_THAT(reply.page.routes, IsEmpty());
    return reply.error;
  };
  const double not_a_number = std::numeric_limits<double>::quiet_NaN();
  const route::Place nowhere{route::Place::Frame::kWgs84, 200.0, 0.0};
  const route::Place unknown{static_cast<route::Place::Frame>(9), 0.0, 0.0};
  EXPECT_THAT(error_of({.name_prefix = "my "}), HasSubstr("name prefix"));
  EXPECT_THAT(error_of({.tags = {"night", ""}}), HasSubstr("tag \"\""));
  EXPECT_THAT(error_of({.tags = std::vector<std::string>(99, "night")}), HasSubstr("tags is 99"));
  EXPECT_THAT(error_of({.scout = "\xFF"}), HasSubstr("scout"));
  EXPECT_THAT(error_of({.camera_prefix = "\x1B[2J"}), HasSubstr("camera prefix"));
  EXPECT_THAT(error_of({.min_length_m = -1.0}), HasSubstr("least length"));
  EXPECT_THAT(error_of({.max_length_m = not_a_number}), HasSubstr("largest length"));
  EXPECT_THAT(error_of({.state = static_cast<route::RouteState>(7)}), HasSubstr("state"));
  EXPECT_THAT(error_of({.near = route::Surroundings{nowhere, 5.0}}), HasSubstr("longitude"));
  EXPECT_THAT(error_of({.near = route::Surroundings{unknown, 5.0}}), HasSubstr("place frame"));
  EXPECT_THAT(error_of({.near = route::Surroundings{{}, 0.0}}), HasSubstr("radius"));
  EXPECT_THAT(error_of({.order = static_cast<route::RouteOrder>(5)}), HasSubstr("order"));
  EXPECT_THAT(error_of({.cursor = "n/x/y"}), HasSubstr("cursor"));
}

TEST_F(Catalog, DamagedStoreIsSaidInTheReply) {
  Put("yard", 1000);
  const auto whole = Put("road", 2000);
  store_.reset();
  std::ifstream in(file_, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  const std::size_t row = bytes.find("yardscout-1");
  ASSERT_NE(row, std::string::npos);
  bytes[row + 4] = 'S';
  std::ofstream(file_, std::ios::binary) << bytes;
  Open();
  EXPECT_THAT(Ask("").error, HasSubstr("named 'yard') is damaged"));
  EXPECT_THAT(Ask("yard").error, HasSubstr("is damaged"));
  EXPECT_THAT(Ask("nowhere").similar_names, ElementsAre("road", "yard"));
  EXPECT_THAT(Ask("road").page.routes, ElementsAre(whole));
}

}  // namespace
}  // namespace trailcast::catalog
