#include "services/lab/trial/scenario.h"

#include <gmock/gmock.h>

#include <set>

#include "services/lab/sim/core/camera.h"
#include "services/lab/sim/places/place.h"

namespace trailcast::trial {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

TEST(Scenarios, HappenInPlacesThatThereAre) {
  for (const Scenario& each : Scenarios()) {
    EXPECT_THAT(sim::BuiltInPlaces(), Contains(each.place)) << each.name;
    EXPECT_FALSE(each.cameras.empty()) << each.name;
    EXPECT_FALSE(each.pushes_m.empty()) << each.name;
    EXPECT_FALSE(each.summary.empty()) << each.name;
  }
}

TEST(Scenarios, UseCamerasThatThereAre) {
  for (const Scenario& each : Scenarios()) {
    for (const CameraPair& pair : each.cameras) {
      for (const std::string& name : {pair.scout, pair.follower}) {
        EXPECT_TRUE(name.empty() || sim::FindCamera(name)) << each.name << ": " << name;
      }
    }
  }
}

TEST(Scenarios, CamerasIsEveryPairOnce) {
  const auto cameras = FindScenario("cameras");
  ASSERT_TRUE(cameras);
  std::set<std::string> pairs;
  for (const CameraPair& pair : cameras->cameras) pairs.insert(pair.scout + ">" + pair.follower);
  EXPECT_EQ(pairs.size(), 36U);
  EXPECT_EQ(cameras->cameras.size(), 36U);
}

TEST(Scenarios, OneThatIsNotThereIsAnErrorThatListsTheOthers) {
  const auto none = FindScenario("moon");
  ASSERT_FALSE(none);
  EXPECT_THAT(none.error().message, HasSubstr("indoor, paved, rough"));
}

}  // namespace
}  // namespace trailcast::trial
