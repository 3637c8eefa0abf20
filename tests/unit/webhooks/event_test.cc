#include "services/webhooks/event.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace trailcast::webhooks {
namespace {

using Json = nlohmann::ordered_json;
using testing::ElementsAre;
using testing::IsEmpty;

constexpr std::int64_t kBegan_ms = 1'000'000;

Json Alert(const std::string& id, std::int64_t since_ms) {
  return {{"alert", id},
          {"since_unix_ms", since_ms},
          {"acknowledged_by", nullptr},
          {"acknowledged_unix_ms", nullptr},
          {"ended_unix_ms", nullptr}};
}

Json Mission(const std::string& id, const std::string& state, std::int64_t changed_ms) {
  return {{"robot", "robot1"}, {"mission", id}, {"state", state}, {"changed_unix_ms", changed_ms}};
}

std::vector<std::string> Names(const std::vector<Event>& events) {
  std::vector<std::string> names;
  for (const Event& event : events) names.push_back(event.name);
  return names;
}

TEST(EventFinder, ToldOfAnAlertFromItsBeginToItsEnd) {
  EventFinder finder;
  EXPECT_THAT(finder.Look(Json::array(), nullptr, kBegan_ms), IsEmpty());
  Json alert = Alert("a1", kBegan_ms + 10);
  const auto began = finder.Look(Json::array({alert}), nullptr, kBegan_ms + 20);
  ASSERT_THAT(Names(began), ElementsAre("alert.began"));
  const Json body = Json::parse(began[0].body);
  EXPECT_EQ(body["id"], began[0].id);
  EXPECT_EQ(body["event"], "alert.began");
  EXPECT_EQ(body["unix_ms"], kBegan_ms + 20);
  EXPECT_EQ(body["alert"], alert);
  EXPECT_THAT(finder.Look(Json::array({alert}), nullptr, kBegan_ms + 30), IsEmpty())
      << "it goes on";
  alert["acknowledged_by"] = "anna";
  alert["acknowledged_unix_ms"] = kBegan_ms + 40;
  EXPECT_THAT(Names(finder.Look(Json::array({alert}), nullptr, kBegan_ms + 41)),
              ElementsAre("alert.acknowledged"));
  alert["ended_unix_ms"] = kBegan_ms + 50;
  EXPECT_THAT(Names(finder.Look(Json::array({alert}), nullptr, kBegan_ms + 51)),
              ElementsAre("alert.ended"));
}

TEST(EventFinder, AMissionsStatesAreToldInOneWord) {
  EventFinder finder;
  (void)finder.Look(Json::array(), Json::array(), kBegan_ms);
  EXPECT_THAT(
      Names(finder.Look(Json::array(), Json::array({Mission("m", "under way", kBegan_ms + 1)}),
                        kBegan_ms + 2)),
      ElementsAre("mission.under-way"));
  EXPECT_THAT(
      Names(finder.Look(Json::array(), Json::array({Mission("m", "arrived", kBegan_ms + 3)}),
                        kBegan_ms + 4)),
      ElementsAre("mission.arrived"));
}

TEST(EventFinder, WhatWasBeforeItsFirstLookIsNoNewsWheneverItIsHeardOf) {
  EventFinder finder;
  const Json early = Mission("m1", "arrived", kBegan_ms - 5);
  const Json heard_later = Mission("m2", "failed", kBegan_ms - 9);
  EXPECT_THAT(
      finder.Look(Json::array({Alert("a", kBegan_ms - 1)}), Json::array({early}), kBegan_ms),
      IsEmpty());
  EXPECT_THAT(finder.Look(Json::array({Alert("a", kBegan_ms - 1)}),
                          Json::array({early, heard_later}), kBegan_ms + 1),
              IsEmpty());
}

TEST(EventFinder, GoesOnAfterARestart) {
  EventFinder before;
  (void)before.Look(Json::array(), Json::array({Mission("m", "under way", kBegan_ms - 5)}),
                    kBegan_ms);
  EventFinder after(before.Seen());
  EXPECT_THAT(after.Look(Json::array(), nullptr, kBegan_ms + 100), IsEmpty()) << "nobody knows";
  EXPECT_THAT(
      Names(after.Look(Json::array({Alert("a", kBegan_ms + 50)}),
                       Json::array({Mission("m", "arrived", kBegan_ms + 60)}), kBegan_ms + 110)),
      ElementsAre("alert.began", "mission.arrived"));
}

TEST(EventFinder, ForgetsTheOldOnesOnceThereAreTooMany) {
  EventFinder finder;
  (void)finder.Look(Json::array(), Json::array(), kBegan_ms);
  for (std::size_t i = 0; i < 3 * EventFinder::kMostSeen; i += 64) {
    Json missions = Json::array();
    for (std::size_t j = i; j < i + 64; ++j) {
      missions.push_back(Mission(std::to_string(j), "arrived", kBegan_ms - 1));
    }
    (void)finder.Look(Json::array(), missions, kBegan_ms + 1);
  }
  EXPECT_LE(finder.Seen().size(), EventFinder::kMostSeen + 65);
}

}  // namespace
}  // namespace trailcast::webhooks
