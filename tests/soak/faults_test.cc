#include "tests/soak/faults.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

namespace trailcast::soak {
namespace {

constexpr int kTypes = 17;
constexpr auto kAny = [](const FaultType&) { return true; };

std::vector<std::string> Draw(std::uint64_t seed, int count) {
  FaultDeck deck(seed);
  std::vector<std::string> drawn;
  for (int i = 0; i < count; ++i) drawn.push_back(deck.Draw(kAny)->Text());
  return drawn;
}

TEST(FaultDeck, EachTypeComesUpOnceBeforeAnyComesUpAgain) {
  const auto drawn = Draw(7, 2 * kTypes);
  const std::set<std::string> first(drawn.begin(), drawn.begin() + kTypes);
  const std::set<std::string> second(drawn.begin() + kTypes, drawn.end());
  EXPECT_EQ(first.size(), static_cast<std::size_t>(kTypes));
  EXPECT_EQ(first, second);
}

TEST(FaultDeck, TheSeedDecidesTheOrder) {
  EXPECT_EQ(Draw(7, 3 * kTypes), Draw(7, 3 * kTypes));
  EXPECT_NE(Draw(7, 3 * kTypes), Draw(8, 3 * kTypes));
}

TEST(FaultDeck, WhatIsNotPossibleNowKeepsItsTurn) {
  FaultDeck deck(7);
  const auto no_kills = [](const FaultType& type) { return type.kind != FaultKind::kKill; };
  for (int i = 0; i < kTypes - 3; ++i) {
    ASSERT_NE(deck.Draw(no_kills)->kind, FaultKind::kKill);
  }
  EXPECT_FALSE(deck.Draw(no_kills));
  for (int i = 0; i < 3; ++i) EXPECT_EQ(deck.Draw(kAny)->kind, FaultKind::kKill);
}

TEST(FaultDeck, WhatWasLeftOutComesUpNoMoreAndHoldsNothingUp) {
  FaultDeck deck(7);
  ASSERT_TRUE(deck.Draw(kAny));
  deck.Leave(FaultKind::kKill, Role::kServer);
  for (int i = 0; i < 4 * kTypes; ++i) {
    const auto drawn = deck.Draw(kAny);
    ASSERT_TRUE(drawn);
    EXPECT_NE(drawn->Text(), "server killed");
  }
}

}  // namespace
}  // namespace trailcast::soak
