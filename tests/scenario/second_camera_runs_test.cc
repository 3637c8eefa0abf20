// The recorded runs once more, replayed by a robot whose camera is not the scout's: larger pictures
// that magnify more, bend, and are brighter.

#include "tests/scenario/recorded_runs.h"

namespace trailcast::test {
namespace {

class SecondCameraRunsTest : public RecordedRunsTest {
 protected:
  const trial::OtherCamera camera_;
};

TEST_F(SecondCameraRunsTest, DonkeyTrackGoesRoundAndTurnsAsItsDriverDid) {
  if (Absent("donkey_track")) GTEST_SKIP() << "no recorded runs at " << Data("donkey_track");
  const Replayed run =
      TeachAndReplay(Data("donkey_track") / "teach", Data("donkey_track") / "replay", camera_);
  EXPECT_EQ(FurthestSegment(run.frames), run.segments - 1) << "the end was not reached";
  const auto steering = ReadSteering(Data("donkey_track") / "replay_steering.csv");
  const Steered steered = AgreementWithDriver(run.frames, steering, 3);
  ASSERT_GT(steered.asked, 150);
  // 0.85 with the scout's own camera.
  EXPECT_GE(steered.agreed, 0.75 * steered.asked) << steered.agreed << " of " << steered.asked;
}

TEST_F(SecondCameraRunsTest, CorridorWalkedOnTheLeftAsksForRight) {
  if (Absent("corridor_offset")) GTEST_SKIP() << "no recorded runs at " << Data("corridor_offset");
  const auto [right, left] = RightAndLeft(
      TeachAndReplay(Data("corridor_offset") / "ref", Data("corridor_offset") / "query", camera_)
          .frames);
  EXPECT_GT(right, left);
}

TEST_F(SecondCameraRunsTest, CorridorWalkedOnTheRightAsksForLeft) {
  if (Absent("corridor_offset")) GTEST_SKIP() << "no recorded runs at " << Data("corridor_offset");
  const auto [right, left] = RightAndLeft(
      TeachAndReplay(Data("corridor_offset") / "query", Data("corridor_offset") / "ref", camera_)
          .frames);
  EXPECT_GT(left, right);
}

TEST_F(SecondCameraRunsTest, PatioUnderOtherLightIsGoneRound) {
  if (Absent("patio_laps")) GTEST_SKIP() << "no recorded runs at " << Data("patio_laps");
  const Replayed run =
      TeachAndReplay(Data("patio_laps") / "lap0", Data("patio_laps") / "lap2", camera_);
  EXPECT_GE(FurthestSegment(run.frames), run.segments - 1);
}

}  // namespace
}  // namespace trailcast::test
