#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "agent/device/obstacle_options.h"

namespace trailcast::agent {
namespace {

using testing::HasSubstr;

TEST(RangeSensor, IsATopicAtTheFront) {
  const auto sensor = ParseRangeSensor("sonar").value();
  EXPECT_EQ(sensor.topic, "sonar");
  EXPECT_FALSE(sensor.mount);
}

TEST(RangeSensor, IsATopicAndWhereItIsMounted) {
  const auto sensor = ParseRangeSensor("/front/left@0.2,-0.1,-30").value();
  EXPECT_EQ(sensor.topic, "/front/left");
  ASSERT_TRUE(sensor.mount);
  EXPECT_DOUBLE_EQ(sensor.mount->x_m, 0.2);
  EXPECT_DOUBLE_EQ(sensor.mount->y_m, -0.1);
  EXPECT_NEAR(sensor.mount->heading_rad, -0.5236, 1e-4);
}

TEST(RangeSensor, OneThatIsNotUnderstoodSaysWhatIsExpected) {
  for (const char* text : {"sonar@", "sonar@0.2", "sonar@0.2,0", "sonar@x,0,0", "sonar@0,0,nan",
                           "sonar@0,0,200", "sonar@9,0,0", "sonar@0,0,0,0"}) {
    const auto sensor = ParseRangeSensor(text);
    ASSERT_FALSE(sensor) << text;
    EXPECT_THAT(sensor.error().message, HasSubstr("as sonar@0.2,-0.1,-30"));
  }
}

}  // namespace
}  // namespace trailcast::agent
