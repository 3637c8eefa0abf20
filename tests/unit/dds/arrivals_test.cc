#include "services/dds/src/arrivals.h"

#include <gtest/gtest.h>

namespace trailcast::dds {
namespace {

TEST(NetworkTowards, IsTheInterfaceFromWhichThisMachineSendsThere) {
  EXPECT_EQ(NetworkTowards("127.0.0.1:7410"), "lo");
  EXPECT_EQ(NetworkTowards("127.0.0.1"), "lo");
}

TEST(NetworkTowards, WhatIsNoAddressLeadsNowhere) {
  for (const char* address : {"", ":7410", "robot1:7410", "[::1]:7410", "300.0.0.1:7410"}) {
    EXPECT_EQ(NetworkTowards(address), "") << address;
  }
}

}  // namespace
}  // namespace trailcast::dds
