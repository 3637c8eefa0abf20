#include "services/base/newest_map.h"

#include <gtest/gtest.h>

#include <string>

namespace trailcast {
namespace {

TEST(NewestMap, KeepsWhatWasTouchedLast) {
  NewestMap<std::string, int> map(2);
  map.Touch("a") = 1;
  map.Touch("b") = 2;
  map.Touch("a") += 10;
  std::pair<std::string, int> gone;
  map.Touch("c", [&](const std::string& key, int value) { gone = {key, value}; }) = 3;
  EXPECT_EQ(gone, std::pair(std::string("b"), 2));
  EXPECT_EQ(map.Find("b"), nullptr);
  ASSERT_NE(map.Find("a"), nullptr);
  EXPECT_EQ(*map.Find("a"), 11);
  EXPECT_EQ(map.size(), 2U);
}

TEST(NewestMap, WhatIsErasedMakesRoom) {
  NewestMap<std::string, int> map(2);
  map.Touch("a") = 1;
  map.Touch("b") = 2;
  map.Erase("a");
  map.Erase("nobody");
  map.Touch("c") = 3;
  EXPECT_EQ(map.size(), 2U);
  EXPECT_NE(map.Find("b"), nullptr);
}

}  // namespace
}  // namespace trailcast
