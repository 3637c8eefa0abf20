#include "services/base/mailbox.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <thread>

namespace trailcast {
namespace {

TEST(MailboxTest, GivesWhatWasPutInOrderAndThenNothing) {
  Mailbox<std::string> mailbox(3);
  EXPECT_TRUE(mailbox.TryPut("a"));
  EXPECT_TRUE(mailbox.TryPut("b"));
  EXPECT_EQ(mailbox.TryGet(), "a");
  EXPECT_EQ(mailbox.TryGet(), "b");
  EXPECT_EQ(mailbox.TryGet(), std::nullopt);
}

TEST(MailboxTest, RefusesWhatDoesNotFitAndLeavesItUntouched) {
  Mailbox<std::unique_ptr<int>> mailbox(2);
  ASSERT_TRUE(mailbox.TryPut(std::make_unique<int>(1)));
  ASSERT_TRUE(mailbox.TryPut(std::make_unique<int>(2)));
  auto third = std::make_unique<int>(3);
  ASSERT_FALSE(mailbox.TryPut(std::move(third)));
  ASSERT_NE(third, nullptr);
  EXPECT_EQ(**mailbox.TryGet(), 1);
  EXPECT_TRUE(mailbox.TryPut(std::make_unique<int>(4)));
}

TEST(MailboxTest, KeepsNothingThatWasTaken) {
  const auto item = std::make_shared<int>(7);
  Mailbox<std::shared_ptr<int>> mailbox(2);
  ASSERT_TRUE(mailbox.TryPut(std::shared_ptr<int>(item)));
  ASSERT_TRUE(mailbox.TryGet());
  EXPECT_EQ(item.use_count(), 1);
}

TEST(MailboxTest, CarriesEverythingBetweenTwoThreads) {
  constexpr int kCount = 20'000;
  Mailbox<int> mailbox(16);
  Bell bell;
  std::thread sender([&] {
    for (int i = 0; i < kCount;) {
      if (!mailbox.TryPut(int{i})) {
        std::this_thread::yield();
        continue;
      }
      ++i;
      bell.Ring();
    }
  });
  int expected = 0;
  int silent_waits = 0;
  while (expected < kCount && silent_waits < 50) {
    while (const auto item = mailbox.TryGet()) {
      ASSERT_EQ(*item, expected);
      ++expected;
    }
    silent_waits = bell.Wait(std::chrono::milliseconds(100)) ? 0 : silent_waits + 1;
  }
  sender.join();
  while (mailbox.TryGet()) ++expected;
  EXPECT_EQ(expected, kCount);
}

TEST(BellTest, RemembersARingThatCameBeforeTheWait) {
  Bell bell;
  bell.Ring();
  bell.Ring();
  EXPECT_TRUE(bell.Wait(std::chrono::milliseconds(0)));
  EXPECT_FALSE(bell.Wait(std::chrono::milliseconds(0)));
}

}  // namespace
}  // namespace trailcast
