#include "services/dds/src/ros2/ros2_speaker.h"

#include <gtest/gtest.h>

namespace trailcast::dds {
namespace {

using std::chrono::milliseconds;

class Ros2SpeakerTest : public testing::Test {
 protected:
  bool Hear(std::int64_t writer) {
    now_ += milliseconds(50);
    return speaker_.Hear(writer, now_, [this](std::int64_t) { return is_there_; });
  }
  [[nodiscard]] bool crowded() const { return speaker_.crowded(now_); }

  Ros2Speaker speaker_;
  Ros2Speaker::Time now_{std::chrono::seconds(100)};
  bool is_there_ = true;
};

TEST_F(Ros2SpeakerTest, OfTwoAtOnceTheFirstIsHeard) {
  EXPECT_TRUE(Hear(1));
  EXPECT_FALSE(Hear(2));
  EXPECT_FALSE(crowded()) << "it may take the other's place";
  EXPECT_TRUE(Hear(1));
  EXPECT_TRUE(crowded());
  EXPECT_FALSE(Hear(2));
  now_ += Ros2Speaker::kTold;
  EXPECT_TRUE(Hear(2)) << "the first is silent";
  EXPECT_FALSE(crowded());
  EXPECT_FALSE(Hear(1)) << "now it is the other one";
  EXPECT_TRUE(Hear(2));
  EXPECT_TRUE(crowded());
}

TEST_F(Ros2SpeakerTest, OneThatTakesThePlaceOfAnotherIsNoSecondOne) {
  EXPECT_TRUE(Hear(1));
  is_there_ = false;
  EXPECT_TRUE(Hear(2)) << "at once, where the first is known to be gone";
  EXPECT_TRUE(Hear(2));
  is_there_ = true;
  for (int i = 0; i < 100; ++i) (void)Hear(3);
  EXPECT_TRUE(Hear(3)) << "and else once it was silent";
  EXPECT_FALSE(crowded());
}

}  // namespace
}  // namespace trailcast::dds
