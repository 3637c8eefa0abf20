#include "services/mission/address.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace trailcast::mission {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(MissionAddress, RobotsThatAreNumberedAlikeAreAGroup) {
  EXPECT_EQ(GroupOf("cart-1"), "cart");
  EXPECT_EQ(GroupOf("cart_12"), "cart");
  EXPECT_EQ(GroupOf("cart3"), "cart");
  EXPECT_EQ(GroupOf("cart.x-3"), "cart.x");
  EXPECT_EQ(GroupOf("lift"), "lift");
  EXPECT_EQ(GroupOf("7"), "7");
  EXPECT_EQ(GroupOf("-7"), "-7");
  EXPECT_TRUE(Means("@cart", "cart-1"));
  EXPECT_TRUE(Means("@lift", "lift"));
  EXPECT_FALSE(Means("@cart", "cart-a"));
  EXPECT_TRUE(Means("cart-1", "cart-1"));
  EXPECT_FALSE(Means("cart-1", "cart-12"));
}

TEST(MissionAddress, AMissionIsForOneRobotAGroupOrSeveral) {
  EXPECT_THAT(ParseAddress("robot1").value(), ElementsAre("robot1"));
  EXPECT_THAT(ParseAddress("@cart,robot1,lift").value(), ElementsAre("@cart", "robot1", "lift"));
  const auto why = [](const std::string& text) {
    const auto parsed = ParseAddress(text);
    return parsed ? std::string() : parsed.error().message;
  };
  for (const char* wrong : {"", "@", "robot 1", "robot1,", ",robot1", "@@cart", "a,,b"}) {
    EXPECT_THAT(why(wrong), HasSubstr("is no robot")) << wrong;
  }
  EXPECT_THAT(why("a,b,a"), HasSubstr("'a' is there twice"));
  EXPECT_THAT(why("cart-1,@cart"), HasSubstr("'cart-1' is one of '@cart'"));
  std::string many = "r0";
  for (int i = 1; i < 17; ++i) many += ",r" + std::to_string(i);
  EXPECT_THAT(why(many), HasSubstr("16 robots at most"));
}

}  // namespace
}  // namespace trailcast::mission
