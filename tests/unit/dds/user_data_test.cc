#include "services/dds/src/domain/user_data.h"

#include <gtest/gtest.h>

namespace trailcast::dds {
namespace {

void ExpectRead(const std::string& text, const std::string& name,
                std::optional<std::uint32_t> version) {
  const UserData data = ParseUserData(text);
  EXPECT_EQ(data.name, name) << text;
  EXPECT_EQ(data.version, version) << text;
}

TEST(UserData, ReadsWhatItWrites) {
  EXPECT_EQ(ToText({"robot1", 12}), "robot1 trailcast-protocol=12");
  ExpectRead("robot1 trailcast-protocol=12", "robot1", 12);
}

TEST(UserData, AVersionAloneIsNoName) {
  EXPECT_EQ(ToText({"", 3}), "trailcast-protocol=3");
  ExpectRead("trailcast-protocol=3", "", 3);
}

TEST(UserData, WhoCallsIsStillTheSame) {
  ExpectRead("robot1 trailcast-protocol=3 ", "robot1", 3);
  ExpectRead("trailcast-protocol=3 ", "", 3);
  ExpectRead("robot1 ", "robot1", std::nullopt);
  ExpectRead(" ", "", std::nullopt);
}

TEST(UserData, WhatIsNotAVersionIsPartOfTheName) {
  for (const char* text : {"robot1", "", "enclave=/;", "robot1 trailcast-protocol=",
                           "robot1 trailcast-protocol=3x", "robot1 trailcast-protocol=-3",
                           "robot1 trailcast-protocol=4294967296", "robot1trailcast-protocol=3"}) {
    ExpectRead(text, text, std::nullopt);
  }
}

}  // namespace
}  // namespace trailcast::dds
