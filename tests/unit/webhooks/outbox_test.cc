#include "services/webhooks/outbox.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace trailcast::webhooks {
namespace {

constexpr std::int64_t kNow_ms = 1'000'000;

std::vector<Hook> Hooks() {
  return ParseHooks(R"([{"url": "http://a", "events": ["alert"]}, {"url": "http://b"}])").value();
}

Event Named(const std::string& id, const std::string& name) { return {id, name, "{}"}; }

TEST(Outbox, EachHookIsToldInOrderOfWhatItWants) {
  Outbox outbox(Hooks());
  outbox.Add(Named("1", "mission.arrived"), kNow_ms);
  outbox.Add(Named("2", "alert.began"), kNow_ms + 1);
  EXPECT_EQ(outbox.waiting(), 3U);
  std::vector<std::string> told;
  while (const auto delivery = outbox.Due(kNow_ms + 2)) {
    told.push_back(Hooks()[delivery->hook].url + " " + delivery->event.id);
    outbox.Arrived(*delivery);
  }
  EXPECT_THAT(told, testing::ElementsAre("http://b 1", "http://a 2", "http://b 2"));
}

TEST(Outbox, AHookThatDoesNotAnswerHoldsBackItsOwnAlone) {
  Outbox outbox(Hooks());
  outbox.Add(Named("1", "alert.began"), kNow_ms);
  const auto first = outbox.Due(kNow_ms);
  ASSERT_TRUE(first && first->hook == 0);
  EXPECT_TRUE(outbox.Failed(*first, kNow_ms));
  const auto second = outbox.Due(kNow_ms);
  ASSERT_TRUE(second);
  EXPECT_EQ(second->hook, 1U);
  outbox.Arrived(*second);
  EXPECT_FALSE(outbox.Due(kNow_ms + 999));
  EXPECT_EQ(outbox.NextDue(), kNow_ms + 1000);
  EXPECT_EQ(outbox.Due(kNow_ms + 1000)->tries, 1);
}

TEST(Outbox, WaitsTwiceAsLongEachTimeAndGivesUpAfterADay) {
  Outbox outbox(Hooks());
  outbox.Add(Named("1", "mission.arrived"), kNow_ms);
  std::int64_t now_ms = kNow_ms;
  std::int64_t last_wait_ms = 0;
  while (const auto delivery = outbox.Due(now_ms)) {
    if (!outbox.Failed(*delivery, now_ms)) break;
    const std::int64_t wait_ms = *outbox.NextDue() - now_ms;
    EXPECT_EQ(wait_ms, last_wait_ms == 0 ? Outbox::kFirstWait_ms
                                         : std::min(2 * last_wait_ms, Outbox::kLongestWait_ms));
    last_wait_ms = wait_ms;
    now_ms += wait_ms;
  }
  EXPECT_EQ(outbox.waiting(), 0U);
  EXPECT_EQ(outbox.dropped(), 1U);
  EXPECT_NEAR(static_cast<double>(now_ms - kNow_ms) / 3'600'000, 24.0, 0.5);
}

TEST(Outbox, AClockThatIsSetBackMakesNobodyWaitForDays) {
  Outbox outbox(Hooks());
  outbox.Add(Named("1", "mission.arrived"), kNow_ms + 40LL * 86'400'000);
  EXPECT_TRUE(outbox.Due(kNow_ms));
}

TEST(Outbox, TheOldestAreDroppedBeyondABound) {
  Outbox outbox(Hooks());
  for (std::size_t i = 0; i < Outbox::kMostWaiting + 3; ++i) {
    const auto overflowing = outbox.Add(Named(std::to_string(i), "mission.arrived"), kNow_ms);
    EXPECT_EQ(overflowing.empty(), i < Outbox::kMostWaiting) << i;
  }
  EXPECT_EQ(outbox.waiting(), Outbox::kMostWaiting);
  EXPECT_EQ(outbox.dropped(), 3U);
  EXPECT_EQ(outbox.Due(kNow_ms)->event.id, "3");
}

TEST(Outbox, WhatWaitsOutlastsARestartAlsoWhereHooksHaveChanged) {
  Outbox outbox(Hooks());
  outbox.Add(Named("1", "alert.began"), kNow_ms);
  (void)outbox.Failed(*outbox.Due(kNow_ms), kNow_ms);
  const std::string text = outbox.Text({{"alert a", "began"}});
  const auto same = Outbox::Read(Hooks(), text);
  ASSERT_TRUE(same) << same.error().message;
  EXPECT_EQ(same->seen.at("alert a"), "began");
  EXPECT_EQ(same->outbox.waiting(), 2U);
  EXPECT_EQ(same->outbox.Text(same->seen), text);
  const auto fewer = Outbox::Read(ParseHooks(R"([{"url": "http://b"}])").value(), text);
  EXPECT_EQ(fewer->outbox.waiting(), 1U);
}

TEST(Outbox, AFileOfSomethingElseIsRefused) {
  for (const char* text : {"", "{}", "[1]", R"({"webhooks": 2, "waiting": {}, "seen": {}})",
                           R"({"webhooks": 1, "waiting": {"http://b": [{}]}, "seen": {}})"}) {
    const auto read = Outbox::Read(Hooks(), text);
    ASSERT_FALSE(read) << text;
    EXPECT_EQ(read.error().code, ErrorCode::kCorrupt);
  }
}

}  // namespace
}  // namespace trailcast::webhooks
