#include "tests/soak/verdict.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace trailcast::soak {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

constexpr const char* kCutOff =
    "[warning] so far\n"
    "trailcast-agent: waited 120 s in vain: server 'server' has no active revision of route "
    "'lap-3'; it has a3f9c21@1 (cut off): its teaching was cut off, and robots follow no revision "
    "of it; teach it again, or finish it with 'trailcast-agent teach --unfinished go-on'; ..\n";

TEST(JudgeFollower, WhoArrivedNeedSayNothing) {
  EXPECT_EQ(JudgeFollower(0, "anything", "lap-3", false).value(), "");
}

TEST(JudgeFollower, WhoDidNotArriveSaysWhy) {
  EXPECT_EQ(
      JudgeFollower(3, "[warning] not arrived: LOST (nothing is seen)\n", "lap-3", false).value(),
      "LOST (nothing is seen)");
  EXPECT_FALSE(JudgeFollower(3, "nothing of it", "lap-3", false));
  EXPECT_FALSE(JudgeFollower(1, "not arrived: LOST", "lap-3", true)) << "by another status";
  const auto died = JudgeFollower(139, "its last line", "lap-3", true);
  ASSERT_FALSE(died);
  EXPECT_THAT(died.error().message, HasSubstr("status 139:\nits last line"));
}

TEST(JudgeFollower, ATeachingThatTheSoakCutOffMayBeSaidToBeSo) {
  EXPECT_THAT(JudgeFollower(1, kCutOff, "lap-3", true).value(),
              StartsWith("server 'server' has no active revision of route 'lap-3'"));
  EXPECT_FALSE(JudgeFollower(1, kCutOff, "lap-3", false)) << "it was not";
  EXPECT_FALSE(JudgeFollower(1, kCutOff, "lap-4", true)) << "of another route";
  EXPECT_FALSE(JudgeFollower(3, kCutOff, "lap-3", true)) << "by another status";
  for (const auto* const other :
       {"nobody taught route 'lap-3' within 120 s: server 'server' does not know it",
        "no server answered within 120 s, and robot.db has no route 'lap-3'",
        "waited 120 s in vain: server 'server' has no active revision of route 'lap-3'; it has "
        "a3f9c21@1 (retired): its teaching was cut off, and robots follow no revision of it"}) {
    EXPECT_FALSE(JudgeFollower(1, other, "lap-3", true)) << other;
  }
}

}  // namespace
}  // namespace trailcast::soak
