#include "agent/session/teach_session.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "services/route/digest.h"
#include "tests/support/turning_walk.h"

namespace trailcast::agent {
namespace {

using testing::AllOf;
using testing::HasSubstr;

constexpr int kFrames = 90;

// This is what a robot sees that drives on and turns to either side, ten pictures a second, with
// the camera rolled by so much, and what its odometry says.
struct Drive {
  double roll_deg = 0.0;
  int straight = 0;            // so many frames before the first turn
  double odometry_sign = 1.0;  // of its turns
  bool told = false;           // somebody drives it by commands

  [[nodiscard]] Observation At(int frame) const {
    const int turning = std::max(0, frame - straight);
    Observation seen;
    seen.stamp = FromSeconds(0.1 * frame);
    seen.image = test::Rolled(test::TurningWalkFrame(frame, turning), roll_deg);
    const double heading_rad = test::HeadingAt(turning);
    seen.odometry = motion::Pose2{0.02 * frame, 0.0, odometry_sign * heading_rad};
    if (told) {
      const int before = std::max(0, turning - 1);
      seen.told = motion::VelocityCommand{0.2, (heading_rad - test::HeadingAt(before)) / 0.1};
    }
    return seen;
  }
};

struct Taught {
  std::string bytes;  // of all segments, as they are stored
  int segments = 0;
  std::optional<TaughtAnew> anew;
  std::string error;
  bool turns_told = false;
  int anew_at = 0;
};

Taught Teach(const Drive& drive, TeachOptions options = {}) {
  TeachSession session(options);
  Taught taught;
  const auto keep = [&](const std::optional<route::Segment>& segment) {
    if (!segment) return;
    const auto piece = route::MakePiece({}, *segment);
    taught.bytes.append(piece.bytes.begin(), piece.bytes.end());
    taught.segments += 1;
  };
  for (int i = 0; i < kFrames; ++i) {
    const auto step = session.Observe(drive.At(i));
    if (!step) {
      taught.error = step.error().message;
      return taught;
    }
    if (step->anew) {
      taught = {};
      taught.anew = step->anew;
      taught.anew_at = i;
    }
    keep(step->finished);
    if (const auto more = session.CatchUp()) keep(more->finished);
  }
  while (const auto step = session.CatchUp()) keep(step->finished);
  EXPECT_EQ(session.frame(), kFrames - 1);
  keep(session.Finish());
  taught.turns_told = session.turns_told();
  return taught;
}

TEST(TeachSession, ACameraThatHangsOtherwiseIsTaughtAsIfThatHadBeenSaid) {
  for (const double roll_deg : {90.0, 180.0, 270.0}) {
    SCOPED_TRACE(roll_deg);
    TeachOptions told;
    told.intake.roll_deg = roll_deg;
    const Taught wanted = Teach({roll_deg}, told);
    EXPECT_FALSE(wanted.anew);
    EXPECT_TRUE(wanted.turns_told);
    ASSERT_GE(wanted.segments, 2);
    const Taught taught = Teach({roll_deg});
    ASSERT_TRUE(taught.anew) << taught.error;
    EXPECT_EQ(taught.anew->intake.roll_deg, roll_deg);
    EXPECT_THAT(taught.anew->text,
                HasSubstr(roll_deg == 180.0 ? "looks upside down" : "looks on its side"));
    EXPECT_LT(taught.anew_at, kFrames / 2);
    EXPECT_EQ(taught.segments, wanted.segments);
    EXPECT_TRUE(taught.bytes == wanted.bytes) << "other segments than those of one that was told";
    EXPECT_TRUE(taught.turns_told);
  }
}

TEST(TeachSession, AWrongRollThatWasSaidIsPutRight) {
  TeachOptions wrong;
  wrong.intake.roll_deg = 180.0;
  const Taught taught = Teach({0.0}, wrong);
  ASSERT_TRUE(taught.anew) << taught.error;
  EXPECT_EQ(taught.anew->intake.roll_deg, 0.0);
  EXPECT_TRUE(taught.bytes == Teach({0.0}).bytes);
}

TEST(TeachSession, OfADriveWithoutATurnItIsNotToldHowTheCameraHangs) {
  const Taught taught = Teach({.roll_deg = 180.0, .straight = kFrames});
  EXPECT_FALSE(taught.anew);
  EXPECT_FALSE(taught.turns_told);
  EXPECT_GE(taught.segments, 1);
}

TEST(TeachSession, WhatCannotBeTaughtAgainAnyMoreEndsTheTeaching) {
  TeachOptions few;
  few.most_kept_bytes = std::size_t{20} * test::kTurningWidth_px * test::kTurningHeight_px;
  EXPECT_THAT(Teach({.roll_deg = 180.0, .straight = 40}, few).error,
              AllOf(HasSubstr("looks upside down"), HasSubstr("--camera-roll 180")));
  EXPECT_EQ(Teach({.roll_deg = 0.0, .straight = 40}, few).error, "");
}

// The robot's commands know left from right.
TEST(TeachSession, OdometryThatCountsTurnsTheWrongWayTurnsNoPictureOfARobotThatIsToldHowToDrive) {
  EXPECT_FALSE(Teach({.odometry_sign = -1.0, .told = true}).anew);
  const Taught upside_down = Teach({.roll_deg = 180.0, .odometry_sign = -1.0, .told = true});
  ASSERT_TRUE(upside_down.anew);
  EXPECT_EQ(upside_down.anew->intake.roll_deg, 180.0);
  const Taught alone = Teach({.odometry_sign = -1.0});
  ASSERT_TRUE(alone.anew);
  EXPECT_THAT(alone.anew->text, HasSubstr("or odometry counts turns the wrong way"));
}

}  // namespace
}  // namespace trailcast::agent
