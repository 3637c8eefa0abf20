#include "services/console/network_list.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <nlohmann/json.hpp>

namespace trailcast::console {
namespace {

using nlohmann::json;
using testing::ElementsAre;
using testing::UnorderedElementsAre;

json Part(const NetworkList& list, const NetworkQuery& query = {}) {
  return json::parse(list.Body(query));
}

std::vector<std::string> RoutesOf(const json& part) {
  std::vector<std::string> names;
  for (const json& route : part["network"]["routes"]) names.push_back(route["route"]);
  return names;
}

const NetworkList& ThreeRoutes() {
  static const NetworkList kList(
      {"route yard 30.00", "route hall 10.00", "route Office 8.50", "join hall@9 Office@0.5 both",
       "join Office@8 yard@1", "unused join hall@2@1 Office@3", "join hall@10 hall@0",
       "join gone@1 hall@2", "close hall 3..7", "limit yard speed 0.5", "name loading-bay yard@28",
       "close gone 1..2", "dance hall", "proposed join hall@1 yard@1 confidence 0.82",
       "proposed dance", "lost hall 5..10 2 of 7 cost 1.9", "lost gone 0..5 1 of 1 cost 2.3", ""},
      true);
  return kList;
}

TEST(NetworkListTest, OfARouteThereAreThoseThatItMeetsOrMayMeet) {
  EXPECT_THAT(RoutesOf(Part(ThreeRoutes(), {.of = "hall"})), ElementsAre("hall", "Office", "yard"));
  const json yard = Part(ThreeRoutes(), {.of = "yard"});
  EXPECT_EQ(yard["matched"], 3) << "by what is proposed, too";
  EXPECT_EQ(yard["network"]["proposed"].size(), 1U);
  EXPECT_THAT(RoutesOf(Part(ThreeRoutes(), {.of = "attic"})), ElementsAre());
}

TEST(NetworkListTest, OfAllRoutesThereIsAllThatIsOnThemAndBetweenThem) {
  const json all = Part(ThreeRoutes());
  EXPECT_THAT(RoutesOf(all), ElementsAre("Office", "hall", "yard"));
  const json& network = all["network"];
  ASSERT_EQ(network["joints"].size(), 4U) << network;
  EXPECT_EQ(network["joints"][0]["to"]["along_m"], 0.5);
  EXPECT_EQ(network["joints"][0]["both"], true);
  EXPECT_EQ(network["joints"][2]["used"], false);
  EXPECT_EQ(network["joints"][2]["from"]["route"], "hall@2");
  EXPECT_EQ(network["closed"].size(), 1U);
  EXPECT_EQ(network["closed"][0]["to_m"], 7.0);
  EXPECT_EQ(network["limits"][0]["to_m"], nullptr);
  ASSERT_EQ(network["lost"].size(), 1U) << network;
  EXPECT_EQ(network["lost"][0]["route"], "hall");
  EXPECT_EQ(network["lost"][0]["cost"], 1.9);
  EXPECT_EQ(network["names"][0]["name"], "loading-bay");
  ASSERT_EQ(network["proposed"].size(), 1U) << network;
  EXPECT_EQ(network["proposed"][0]["confidence"], 0.82);
  EXPECT_EQ(all["matched"], 3);
  EXPECT_EQ(all["routes"], 3);
  EXPECT_EQ(all["joints"], 5) << "that of a route that is no more, too";
  EXPECT_EQ(all["left_out"], 0);
  EXPECT_EQ(all["whole"], true);
  EXPECT_EQ(all["elsewhere"], json::array());
}

TEST(NetworkListTest, WhenRobotsChargeAndWhichDoIsInEachPart) {
  const NetworkList list(
      {"route hall 20.00", "route yard 30.00", "name dock1 hall@2 dock, taken by robot1",
       "charge below 20 until 90", "charging robot1 charges at dock1"},
      true);
  for (const char* search : {"hall", "attic"}) {
    const json network = Part(list, {.search = search})["network"];
    EXPECT_EQ(network["charge"], json({{"below_percent", 20}, {"until_percent", 90}}));
    EXPECT_EQ(network["charging"],
              json::parse(R"([{"robot": "robot1", "text": "charges at dock1"}])"));
  }
  const json dock = Part(list)["network"]["names"][0];
  EXPECT_EQ(dock["dock"], true);
  EXPECT_EQ(dock["taken_by"], json({"robot1"}));
}

TEST(NetworkListTest, ASearchIsInNamesOfRoutesAndOfPlaces) {
  EXPECT_THAT(RoutesOf(Part(ThreeRoutes(), {.search = "OFF"})), ElementsAre("Office"));
  EXPECT_THAT(RoutesOf(Part(ThreeRoutes(), {.search = "bay"})), ElementsAre("yard"));
  EXPECT_THAT(RoutesOf(Part(ThreeRoutes(), {.search = "attic"})), ElementsAre());
  const json halls = Part(ThreeRoutes(), {.search = "hall"});
  EXPECT_EQ(halls["matched"], 1);
  EXPECT_EQ(halls["routes"], 3);
  EXPECT_EQ(halls["network"]["joints"].size(), 1U) << "with itself: a ring";
  EXPECT_EQ(halls["elsewhere"], json({{{"route", "hall"}, {"joints", 2}}}));
}

TEST(NetworkListTest, AroundARouteAreThoseThatAreNearestByJunctions) {
  EXPECT_THAT(RoutesOf(Part(ThreeRoutes(), {.around = "hall", .limit = 2})),
              UnorderedElementsAre("hall", "Office"));
  EXPECT_THAT(RoutesOf(Part(ThreeRoutes(), {.around = "yard", .limit = 2})),
              UnorderedElementsAre("yard", "Office"));
  EXPECT_EQ(Part(ThreeRoutes(), {.around = "attic"})["matched"], 0);
}

TEST(NetworkListTest, OfTenThousandRoutesAPageIsToldAFew) {
  std::vector<std::string> lines;
  lines.reserve(63'000);
  for (int i = 0; i < 10'000; ++i) lines.push_back(fmt::format("route aisle-{:05} 20.00", i));
  for (int i = 0; i < 50'000; ++i) {
    lines.push_back(fmt::format("join aisle-{:05}@{} aisle-{:05}@1", i % 10'000, 2 + i / 10'000,
                                (i + 1 + 37 * (i / 10'000)) % 10'000));
  }
  for (int i = 0; i < 3000; ++i) lines.push_back(fmt::format("close aisle-00000 {}..{}.5", i, i));
  const NetworkList list(lines, false);
  const std::string body = list.Body({});
  EXPECT_LT(body.size(), 400'000U);
  const json part = json::parse(body);
  EXPECT_EQ(part["network"]["routes"].size(), 60U);
  EXPECT_EQ(part["network"]["closed"].size(), NetworkList::kMostMarks);
  EXPECT_EQ(part["left_out"], 1000);
  EXPECT_EQ(part["matched"], 10'000);
  EXPECT_EQ(part["whole"], false);
  EXPECT_EQ(Part(list, {.search = "aisle-0123"})["matched"], 10);
  EXPECT_EQ(Part(list, {.around = "aisle-05000", .limit = 500})["network"]["routes"].size(), 500U);
}

TEST(NetworkListTest, WhatServersSayMayBeAnything) {
  const NetworkList list({"route \xff\"\n 5", "route  7", "route hall 1e999", "join \xff@1 x@2",
                          "name a\"b hall@0", "route hall 3.00", "route hall 4.00"},
                         true);
  const json part = json::parse(list.Body({}), nullptr, false);
  EXPECT_FALSE(part.is_discarded());
  EXPECT_EQ(Part(NetworkList({}, true))["routes"], 0);
}

}  // namespace
}  // namespace trailcast::console
