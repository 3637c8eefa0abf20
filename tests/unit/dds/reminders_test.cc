#include "services/dds/src/reminders.h"

#include <gtest/gtest.h>

#include <vector>

namespace trailcast::dds {
namespace {

using std::chrono::milliseconds;

class RemindersTest : public testing::Test {
 protected:
  // The places whose readers are reminded.
  std::vector<Place> Tick() {
    std::vector<Place> reminded;
    reminders_.Tick(
        now_, [this](const Place& place) { return confirmed_.contains(place); },
        [&](const Place& place) { reminded.push_back(place); });
    return reminded;
  }

  const Place segments_{exchange::Topic::kSegments, "a"};
  const Place requests_{exchange::Topic::kSegmentRequests};
  Reminders reminders_;
  std::set<Place> confirmed_;
  Reminders::Time now_{};
};

TEST_F(RemindersTest, RemindsEverMoreRarelyUntilConfirmed) {
  reminders_.NoteWritten(segments_, now_);
  EXPECT_TRUE(Tick().empty());
  now_ += Reminders::kFirst;
  EXPECT_EQ(Tick(), std::vector{segments_});
  EXPECT_TRUE(Tick().empty()) << "reminded again at once";
  now_ += Reminders::kFirst;
  EXPECT_TRUE(Tick().empty()) << "as soon as the first time";
  now_ += Reminders::kFirst;
  EXPECT_EQ(Tick(), std::vector{segments_});
  confirmed_.insert(segments_);
  now_ += 4 * Reminders::kFirst;
  EXPECT_TRUE(Tick().empty());
  confirmed_.clear();
  now_ += Reminders::kMost;
  EXPECT_TRUE(Tick().empty()) << "reminded of what was confirmed";
}

TEST_F(RemindersTest, LeavesAloneWhoSaysNothing) {
  reminders_.NoteWritten(segments_, now_);
  int reminded = 0;
  for (int i = 0; i < 100; ++i) {
    now_ += Reminders::kFirst;
    reminded += static_cast<int>(Tick().size());
  }
  EXPECT_EQ(reminded, 5);  // after 20, 60, 140, 300 and 620 ms
}

TEST_F(RemindersTest, WaitsForTheOneThatIsDueFirst) {
  EXPECT_EQ(reminders_.Wait(now_, milliseconds(50)), milliseconds(50));
  reminders_.NoteWritten(segments_, now_);
  reminders_.NoteWritten(requests_, now_ + milliseconds(5));
  EXPECT_EQ(reminders_.Wait(now_, milliseconds(50)), Reminders::kFirst);
  EXPECT_EQ(reminders_.Wait(now_, milliseconds(3)), milliseconds(3));
  now_ += 2 * Reminders::kFirst;
  EXPECT_EQ(reminders_.Wait(now_, milliseconds(50)), milliseconds(0));
}

}  // namespace
}  // namespace trailcast::dds
