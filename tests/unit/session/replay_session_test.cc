#include "agent/session/replay_session.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>
#include <utility>
#include <vector>

#include "agent/session/teach_session.h"
#include "services/vision/picture_intake.h"
#include "tests/support/turning_walk.h"
#include "tests/support/walk_frames.h"

namespace trailcast::agent {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr int kFrames = 60;
constexpr double kFrames_hz = 20.0;
constexpr double kStep_m = 0.02;

SensorTime StampOf(int frame) { return FromSeconds(frame / kFrames_hz); }

std::optional<motion::Pose2> PoseAt(int frame, bool odometry, double step_m = kStep_m) {
  if (!odometry) return std::nullopt;
  return motion::Pose2{step_m * frame, 0.0, 0.0};
}

const std::vector<image::GrayImage>& Walk() {
  static const std::vector<image::GrayImage> walk = [] {
    std::vector<image::GrayImage> frames;
    for (int i = 0; i < kFrames; ++i) frames.push_back(test::WalkFrame(i));
    return frames;
  }();
  return walk;
}

// Past another wall first, of which nothing is in the second.
const std::vector<image::GrayImage>& TwoWalls() {
  static const std::vector<image::GrayImage> walls = [] {
    std::vector<image::GrayImage> frames = Walk();
    for (image::GrayImage& frame : frames) {
      std::reverse(frame.pixels.begin(), frame.pixels.end());
      for (std::uint8_t& pixel : frame.pixels) pixel = static_cast<std::uint8_t>(255 - pixel);
    }
    frames.insert(frames.end(), Walk().begin(), Walk().end());
    return frames;
  }();
  return walls;
}

std::vector<route::Segment> Taught(bool odometry,
                                   const std::vector<image::GrayImage>& frames = Walk(),
                                   double step_m = kStep_m) {
  TeachSession session;
  std::vector<route::Segment> segments;
  const auto keep = [&](std::optional<route::Segment> segment) {
    if (segment) segments.push_back(std::move(*segment));
  };
  for (int i = 0; i < static_cast<int>(frames.size()); ++i) {
    auto step = session.Observe(
        {StampOf(i), frames[static_cast<std::size_t>(i)], PoseAt(i, odometry, step_m)});
    EXPECT_TRUE(step);
    keep(std::move(step->finished));
  }
  keep(session.Finish());
  return segments;
}

ReplaySession SessionOn(const std::vector<route::Segment>& segments,
                        const ReplayMethodOptions& options = {}) {
  route::RouteInfo info;
  info.image_width_px = Walk().front().width;
  info.image_height_px = Walk().front().height;
  ReplaySession session(options, info);
  for (const route::Segment& segment : segments) EXPECT_TRUE(session.AddSegment(segment));
  session.MarkComplete();
  return session;
}

bool Stands(const ReplayStep& step) {
  return step.command.linear_mps == 0.0 && step.command.angular_radps == 0.0;
}

image::GrayImage Noise(unsigned seed) {
  image::GrayImage picture = Walk().front();
  std::mt19937 random(seed);
  for (std::uint8_t& pixel : picture.pixels) pixel = static_cast<std::uint8_t>(random());
  return picture;
}

class ReplaySessionTest : public testing::TestWithParam<bool> {
 protected:
  [[nodiscard]] static bool odometry() { return GetParam(); }
};

INSTANTIATE_TEST_SUITE_P(Odometry, ReplaySessionTest, testing::Bool(),
                         [](const auto& param) { return param.param ? "With" : "Without"; });

TEST_P(ReplaySessionTest, WhatWasTaughtIsFollowedInEveryFrame) {
  ReplaySession session = SessionOn(Taught(odometry()));
  for (int i = 0; i < kFrames; ++i) {
    const auto step =
        session.Observe({StampOf(i), Walk()[static_cast<std::size_t>(i)], PoseAt(i, odometry())});
    ASSERT_TRUE(step);
    EXPECT_TRUE(step->state == ReplayState::kFollowing || step->state == ReplayState::kArrived)
        << "frame " << i << ": " << ToString(step->state) << ", " << step->reason;
    EXPECT_NEAR(step->believed->place, i / (kFrames - 1.0), 0.15) << i;
  }
}

// A route taught with odometry or without it, by a robot that has none: what it is told to drive,
// and the pictures, are all that there is.
TEST_P(ReplaySessionTest, IsFollowedByWhatTheBaseIsTold) {
  ReplaySession session = SessionOn(Taught(odometry()));
  ReplayStep step;
  for (int i = 0; i < kFrames; ++i) {
    Observation seen;
    seen.stamp = StampOf(i);
    seen.image = Walk()[static_cast<std::size_t>(i)];
    seen.told = motion::VelocityCommand{kStep_m * kFrames_hz, 0.0};
    step = session.Observe(seen).value();
    EXPECT_TRUE(step.state == ReplayState::kFollowing || step.state == ReplayState::kArrived)
        << "frame " << i << ": " << ToString(step.state) << ", " << step.reason;
    EXPECT_NEAR(step.believed->place, i / (kFrames - 1.0), 0.25) << i;
    EXPECT_FALSE(step.odometry);
  }
  EXPECT_NE(step.evidence, Evidence::kMotion);
}

// Whatever tells how it moves: FOLLOWING is what it says only while something of the route agrees.
TEST_P(ReplaySessionTest, FollowsForASecondAtMostOnceNothingAgrees) {
  constexpr int kLastSeen = 25;
  for (const bool told : {false, true}) {
    ReplaySession session = SessionOn(Taught(odometry()));
    int since = 0;
    for (int i = 0; i < kFrames + 40; ++i) {
      Observation seen;
      seen.stamp = StampOf(i);
      seen.image = i <= kLastSeen ? Walk()[static_cast<std::size_t>(i)] : Noise(7U + unsigned(i));
      seen.odometry = PoseAt(i, odometry());
      if (told) seen.told = motion::VelocityCommand{kStep_m * kFrames_hz, 0.0};
      const ReplayStep step = session.Observe(seen).value();
      since = i <= kLastSeen ? 0 : since + 1;
      if (step.state != ReplayState::kFollowing) continue;
      EXPECT_LE(since, kFrames_hz) << "told " << told << ", frame " << i;
      EXPECT_NE(step.evidence, Evidence::kMotion);
    }
  }
}

TEST(ReplaySessionOdometry, HasAScaleOnlyOnARouteThatHasMetres) {
  for (const bool metres : {false, true}) {
    ReplaySession session = SessionOn(Taught(metres));
    for (int i = 0; i < 5; ++i) {
      const ReplayStep step =
          session.Observe({StampOf(i), Walk()[static_cast<std::size_t>(i)], PoseAt(i, true)})
              .value();
      ASSERT_TRUE(step.odometry);
      EXPECT_EQ(step.odometry->scale.has_value(), metres);
    }
  }
}

TEST(ReplaySessionOdometry, ThatStandsWhileThePictureMovesIsNotBelieved) {
  constexpr double kFast_m = 0.1;
  ReplaySession session = SessionOn(Taught(true, Walk(), kFast_m));
  int follows = 0;
  ReplayStep step;
  for (int i = 0; i < kFrames; ++i) {
    step =
        session.Observe({StampOf(i), Walk()[static_cast<std::size_t>(i)], PoseAt(0, true)}).value();
    if (step.state == ReplayState::kFollowing || step.state == ReplayState::kArrived) ++follows;
    // Before a wall ten metres away a metre more or less shows next to nothing.
    EXPECT_NEAR(step.progress, i / (kFrames - 1.0), 0.35) << "frame " << i;
  }
  EXPECT_GE(follows, 9 * kFrames / 10);
  ASSERT_TRUE(step.odometry);
  EXPECT_LT(step.odometry->trust, 0.4);
}

TEST_P(ReplaySessionTest, BeginsAnywhereIfToldSo) {
  constexpr int kFirst = 30;
  ReplayMethodOptions options;
  options.anywhere = true;
  ReplaySession session = SessionOn(Taught(odometry()), options);
  std::optional<int> found_at;
  for (int i = kFirst; i < kFrames && !found_at; ++i) {
    const auto step =
        session.Observe({StampOf(i), Walk()[static_cast<std::size_t>(i)], PoseAt(i, odometry())});
    ASSERT_TRUE(step);
    if (step->state != ReplayState::kFollowing) {
      EXPECT_TRUE(Stands(*step)) << step->reason;
      continue;
    }
    found_at = i;
    EXPECT_NEAR(step->believed->place, i / (kFrames - 1.0), 0.15);
  }
  ASSERT_TRUE(found_at);
  EXPECT_LE(*found_at, kFirst + 15);
}

TEST_P(ReplaySessionTest, NotAtTheStartItLooksAlongTheWholeRouteIfItMay) {
  constexpr int kStands = kFrames + 20;  // at this frame, for 3 s
  ReplayMethodOptions options;
  options.else_anywhere = true;
  ReplaySession session = SessionOn(Taught(odometry(), TwoWalls()), options);
  std::optional<double> found;
  for (int i = 0; i < 90 && !found; ++i) {
    const auto step =
        session.Observe({StampOf(i), TwoWalls()[kStands], PoseAt(kStands, odometry())});
    ASSERT_TRUE(step);
    if (step->state == ReplayState::kFollowing) {
      found = step->believed->place;
    } else {
      EXPECT_TRUE(Stands(*step)) << step->reason;
    }
  }
  ASSERT_TRUE(found);
  EXPECT_NEAR(*found, kStands / (2.0 * kFrames - 1.0), 0.15);
}

// A wall that is 10 m ahead at the route's beginning (10 cm nearer: one percent larger).
TEST(ReplaySessionOutside, IsNotTakenToBeAtTheBeginningFromWellBeforeIt) {
  ReplayMethodOptions options;
  options.anywhere = true;
  ReplaySession session = SessionOn(Taught(true, Walk(), 0.1), options);
  const image::GrayImage before = test::WalkFrame(-25);
  ReplayStep step;
  for (int i = 0; i < 90; ++i) {
    step = session.Observe({StampOf(i), before, PoseAt(0, true)}).value();
    EXPECT_TRUE(Stands(step)) << step.reason;
    EXPECT_NE(step.state, ReplayState::kFollowing) << i;
  }
  EXPECT_THAT(step.reason, HasSubstr("before its beginning"));
}

TEST(ReplaySessionOutside, DoesNotGuessWhereTwoPlacesLookAlike) {
  std::vector<image::GrayImage> twice = Walk();
  twice.insert(twice.end(), Walk().begin(), Walk().end());
  ReplayMethodOptions options;
  options.anywhere = true;
  ReplaySession session = SessionOn(Taught(true, twice, 0.1), options);
  ReplayStep step;
  for (int i = 0; i < 90; ++i) {
    step = session.Observe({StampOf(i), Walk()[30], PoseAt(0, true)}).value();
    EXPECT_TRUE(Stands(step)) << step.reason;
    EXPECT_NE(step.state, ReplayState::kFollowing) << i;
  }
  EXPECT_EQ(step.state, ReplayState::kLost);
  EXPECT_THAT(step.reason, HasSubstr("along the route it looks alike"));
}

// It was about to compare places once more when it gave up.
TEST(ReplaySessionOutside, WhatWasComparedCountsForNothingOnceSomethingElseIsSeen) {
  constexpr double kSlower_hz = 7.0;
  constexpr int kGaveUp = 25;
  std::vector<image::GrayImage> twice = Walk();
  twice.insert(twice.end(), Walk().begin(), Walk().end());
  ReplayMethodOptions options;
  options.anywhere = true;
  ReplaySession session = SessionOn(Taught(true, twice, 0.1), options);
  for (int i = 0; i < kGaveUp + 20; ++i) {
    const image::GrayImage picture =
        i < kGaveUp ? Walk()[30] : Noise(static_cast<unsigned>(i) + 1U);
    const ReplayStep step =
        session.Observe({FromSeconds(i / kSlower_hz), picture, PoseAt(0, true)}).value();
    EXPECT_TRUE(Stands(step)) << i;
    EXPECT_THAT(step.reason, HasSubstr("looks where on the route it is")) << i;
  }
}

TEST(ReplaySessionLost, LooksForItselfAlongTheWholeRouteAndGoesOn) {
  constexpr int kFollows = 20;
  constexpr int kPutTo = 45;
  ReplayMethodOptions options;
  options.else_anywhere = true;
  ReplaySession session = SessionOn(Taught(true), options);
  int i = 0;
  const auto look = [&](const image::GrayImage& picture) {
    const auto step = session.Observe({StampOf(i), picture, PoseAt(std::min(i, kFollows), true)});
    ++i;
    return step.value();
  };
  while (i < kFollows) (void)look(Walk()[static_cast<std::size_t>(i)]);
  constexpr int kCovered = 450;
  ReplayStep step;
  while (i < kCovered && step.reason.find("it has lost its path") == std::string::npos) {
    step = look(Noise(static_cast<unsigned>(i)));
    EXPECT_NE(step.state, ReplayState::kLost) << step.reason;
  }
  EXPECT_THAT(step.reason, HasSubstr("looks where on the route it is"));
  const int put_at = i;
  while (i < put_at + 60 && step.state != ReplayState::kFollowing) {
    EXPECT_TRUE(Stands(step)) << step.reason;
    step = look(Walk()[kPutTo]);
  }
  ASSERT_EQ(step.state, ReplayState::kFollowing) << step.reason;
  EXPECT_NEAR(step.believed->place, kPutTo / (kFrames - 1.0), 0.15);
}

TEST_P(ReplaySessionTest, NothingOfTheRouteInViewIsNeverFollowed) {
  ReplaySession session = SessionOn(Taught(odometry()));
  ReplayStep last;
  for (int i = 0; i < 120; ++i) {
    const auto step =
        session.Observe({StampOf(i), Noise(static_cast<unsigned>(i) + 1U), PoseAt(0, odometry())});
    ASSERT_TRUE(step);
    EXPECT_NE(step->state, ReplayState::kFollowing) << i;
    EXPECT_TRUE(Stands(*step)) << i;
    last = *step;
  }
  EXPECT_EQ(last.state, ReplayState::kLost);
  EXPECT_NE(last.reason, "");
}

TEST_P(ReplaySessionTest, APictureOfAnotherSizeStopsTheRobotAndEndsNothing) {
  ReplaySession session = SessionOn(Taught(odometry()));
  for (int i = 0; i < 30; ++i) {
    const bool other = i >= 10 && i < 15;
    const auto step = session.Observe(
        {StampOf(i), other ? test::WalkFrame(i, 80, 60) : Walk()[static_cast<std::size_t>(i)],
         PoseAt(i, odometry())});
    ASSERT_TRUE(step) << step.error().message;
    if (!other) continue;
    EXPECT_EQ(step->state, ReplayState::kBlind);
    EXPECT_TRUE(Stands(*step));
    EXPECT_THAT(step->reason, HasSubstr("80x60"));
  }
  const auto after = session.Observe({StampOf(30), Walk()[30], PoseAt(30, odometry())});
  ASSERT_TRUE(after);
  EXPECT_EQ(after->state, ReplayState::kFollowing) << after->reason;
}

TEST_P(ReplaySessionTest, ACameraThatGivesNoPicturesAtAllIsLost) {
  ReplaySession session = SessionOn(Taught(odometry()));
  ReplayStep last;
  for (int i = 0; i < 100; ++i) {
    const auto step = session.Observe({StampOf(i), {}, PoseAt(0, odometry())});
    ASSERT_TRUE(step);
    last = *step;
  }
  EXPECT_EQ(last.state, ReplayState::kLost);
  EXPECT_THAT(last.reason, HasSubstr("empty frame"));
}

TEST_P(ReplaySessionTest, ACameraThatHangsOtherwiseThanTheScoutsIsToldAndItsPicturesTurned) {
  for (const double turn_deg : {180.0, 90.0, 270.0}) {
    ReplaySession session = SessionOn(Taught(odometry()));
    ReplayStep last;
    for (int i = 0; i < kFrames; ++i) {
      const auto step =
          session.Observe({StampOf(i), test::Rolled(Walk()[static_cast<std::size_t>(i)], turn_deg),
                           PoseAt(i, odometry())});
      ASSERT_TRUE(step);
      last = *step;
      if (i >= 5) {
        EXPECT_TRUE(last.state == ReplayState::kFollowing || last.state == ReplayState::kArrived)
            << "frame " << i << ": " << ToString(last.state) << ", " << last.reason;
      } else {
        EXPECT_TRUE(last.turned.empty() || Stands(last) || last.state == ReplayState::kFollowing);
      }
    }
    EXPECT_THAT(last.turned, HasSubstr(turn_deg == 180.0 ? "upside down" : "on its side"));
    EXPECT_THAT(last.turned, HasSubstr(fmt::format("--camera-roll {:g}", turn_deg)));
    EXPECT_EQ(session.picture()->width, Walk().front().width);
  }
}

// In a whole fleet all cameras hang alike, and nobody has said so.
struct Turning {
  double roll_deg = 0.0;
  double odometry_sign = 1.0;
  double base_sign = 1.0;  // of how the robot turns when it is told to turn
};

ReplayStep FollowTurning(const Turning& robot) {
  constexpr int kTurning = 90;
  const auto seen = [&](int frame) {
    Observation observation;
    observation.stamp = FromSeconds(0.1 * frame);
    observation.image = test::Rolled(test::TurningWalkFrame(frame, frame), robot.roll_deg);
    observation.odometry =
        motion::Pose2{kStep_m * frame, 0.0, robot.odometry_sign * test::HeadingAt(frame)};
    return observation;
  };
  TeachOptions unwatched;
  unwatched.most_kept_bytes = 0;
  TeachSession scout(unwatched);
  std::vector<route::Segment> segments;
  for (int i = 0; i < kTurning; ++i) {
    Observation without_turns = seen(i);
    without_turns.odometry->heading_rad = 0.0;  // by which it would see how its camera hangs
    auto step = scout.Observe(without_turns);
    EXPECT_TRUE(step);
    if (step->finished) segments.push_back(std::move(*step->finished));
  }
  if (auto last = scout.Finish()) segments.push_back(std::move(*last));
  ReplaySession session = SessionOn(segments);
  ReplayStep last;
  for (int i = 0; i < kTurning; ++i) {
    Observation observation = seen(i);
    const double turned_rad = test::HeadingAt(i) - test::HeadingAt(std::max(0, i - 1));
    observation.told = motion::VelocityCommand{kStep_m / 0.1, robot.base_sign * turned_rad / 0.1};
    auto step = session.Observe(observation);
    EXPECT_TRUE(step);
    last = *step;
    if (last.state == ReplayState::kLost) return last;
  }
  return last;
}

TEST(ReplaySessionTurning, StandsWhereThePictureTurnsAgainstTheRobotThoughTheRouteLooksTheSame) {
  EXPECT_THAT(FollowTurning({}).reason, Not(HasSubstr("the camera looks")));
  const ReplayStep upside_down = FollowTurning({.roll_deg = 180.0});
  EXPECT_EQ(upside_down.state, ReplayState::kLost);
  EXPECT_TRUE(Stands(upside_down));
  EXPECT_THAT(upside_down.reason, HasSubstr("the camera looks upside down"));
  EXPECT_THAT(upside_down.reason, HasSubstr("teach the route again"));
  EXPECT_THAT(upside_down.reason, HasSubstr("--camera-roll 180"));
}

TEST(ReplaySessionTurning, TellsABaseThatTurnsTheWrongWayFromACameraUpsideDownByOdometry) {
  const ReplayStep base = FollowTurning({.base_sign = -1.0});
  EXPECT_EQ(base.state, ReplayState::kLost);
  EXPECT_THAT(base.reason, HasSubstr("turn the sign of angular.z"));
  EXPECT_THAT(FollowTurning({.odometry_sign = -1.0}).reason, Not(HasSubstr("the camera looks")));
}

TEST_P(ReplaySessionTest, ACameraThatHangsOtherwiseIsFollowedWithWhenThatIsSaid) {
  for (const double turn_deg : {180.0, 90.0, -90.0}) {
    ReplayMethodOptions options;
    options.intake.roll_deg = turn_deg;
    ReplaySession session = SessionOn(Taught(odometry()), options);
    for (int i = 0; i < kFrames; ++i) {
      const auto step =
          session.Observe({StampOf(i), test::Rolled(Walk()[static_cast<std::size_t>(i)], turn_deg),
                           PoseAt(i, odometry())});
      ASSERT_TRUE(step);
      EXPECT_TRUE(step->state == ReplayState::kFollowing || step->state == ReplayState::kArrived)
          << "frame " << i << ": " << ToString(step->state) << ", " << step->reason;
    }
  }
}

// Segments come one by one; where the robot is on the route does not depend on how many have.
TEST_P(ReplaySessionTest, ProgressIsOfTheWholeRouteAlsoWhileItComes) {
  std::vector<route::Segment> segments = Taught(odometry());
  ASSERT_GE(segments.size(), 1U);
  route::RouteInfo info;
  info.image_width_px = Walk().front().width;
  info.image_height_px = Walk().front().height;
  info.segment_count = 20;
  ReplaySession session({}, info);
  ASSERT_TRUE(session.AddSegment(segments.front()));
  const auto step = session.Observe({StampOf(0), Walk().front(), PoseAt(0, odometry())});
  ASSERT_TRUE(step);
  EXPECT_LE(step->progress, 1.0 / 20.0);
  for (int i = 1; i < 10; ++i) {
    const auto next =
        session.Observe({StampOf(i), Walk()[static_cast<std::size_t>(i)], PoseAt(i, odometry())});
    ASSERT_TRUE(next);
    EXPECT_LE(next->progress, 1.0 / 20.0);
  }
}

// It may as well be at the beginning of a lap: it has not come there.
// The walk, a turn on the spot, and the walk again: what the robot sees after the turn.
struct Turned {
  ReplayStep last;
  double turned_rad = 0.0;
  bool drove_on = false;
};

Turned TurnAndSee(bool the_way_on) {
  constexpr double kTurn_rad = 1.2;
  std::vector<route::Segment> segments = Taught(true);
  route::Segment again = segments.front();
  again.index = SegmentIndex(static_cast<std::uint32_t>(segments.size()));
  again.turn_before_rad = kTurn_rad;
  segments.push_back(again);
  ReplaySession session = SessionOn(segments);
  Turned turned;
  motion::Pose2 pose;
  std::size_t walked = 0;
  for (int i = 0; i < 400 && turned.last.state != ReplayState::kLost && !turned.drove_on; ++i) {
    const bool turns = turned.last.command.angular_radps != 0.0 && walked + 1 >= Walk().size();
    const bool there = turned.turned_rad > kTurn_rad - 0.1;
    const bool sees = walked + 1 < Walk().size() || (turned.turned_rad == 0.0 && !turns);
    const image::GrayImage picture = sees                  ? Walk()[walked]
                                     : there && the_way_on ? Walk().front()
                                                           : Noise(static_cast<unsigned>(i) + 1U);
    const auto step = session.Observe({StampOf(i), picture, pose});
    EXPECT_TRUE(step);
    turned.last = *step;
    const motion::VelocityCommand& command = turned.last.command;
    turned.drove_on = there && command.linear_mps > 0.0;
    if (command.linear_mps > 0.0) {
      pose = motion::Advance(pose, {kStep_m, 0.0});
      walked = std::min(walked + 1, Walk().size() - 1);
    } else {
      pose = motion::Advance(pose, {0.0, command.angular_radps / kFrames_hz});
      turned.turned_rad += command.angular_radps / kFrames_hz;
    }
  }
  EXPECT_NEAR(turned.turned_rad, kTurn_rad, 0.1);
  return turned;
}

TEST(ReplaySessionTurning, GoesOnAfterATurnOnTheSpotWhenItSeesTheWayOn) {
  const Turned turned = TurnAndSee(true);
  EXPECT_TRUE(turned.drove_on) << turned.last.reason;
}

TEST(ReplaySessionTurning, StandsAfterATurnOnTheSpotWhereItDoesNotSeeTheWayOn) {
  const Turned turned = TurnAndSee(false);
  EXPECT_FALSE(turned.drove_on);
  EXPECT_EQ(turned.last.state, ReplayState::kLost);
  EXPECT_THAT(turned.last.reason,
              HasSubstr("after turning on the spot by 69 degrees the way on is not found"));
}

// In mid-walk the robot is turned, which its odometry does not feel: what it sees then is not the
// path, but for where it faces along it.
struct Thrown {
  ReplayStep last;
  double facing_rad = 0.0;
  double furthest_rad = 0.0;  // that it turned from where it was thrown
  bool drove_on = false;
  bool drove_astray = false;
};

Thrown ThrowBy(double thrown_rad, double look_around_rad) {
  constexpr std::size_t kThrownAt = 30;
  constexpr double kSees_rad = 0.1;
  ReplayMethodOptions options;
  options.look_around_rad = look_around_rad;
  ReplaySession session = SessionOn(Taught(true), options);
  Thrown thrown;
  motion::Pose2 pose;
  std::size_t walked = 0;
  bool was_thrown = false;
  for (int i = 0; i < 2000 && thrown.last.state != ReplayState::kLost && !thrown.drove_on; ++i) {
    const bool sees = std::abs(thrown.facing_rad) < kSees_rad;
    const auto step = session.Observe({StampOf(i), sees ? Walk()[walked] : Noise(7), pose});
    EXPECT_TRUE(step);
    thrown.last = *step;
    const motion::VelocityCommand& command = thrown.last.command;
    thrown.drove_astray = thrown.drove_astray || (!sees && command.linear_mps != 0.0);
    thrown.drove_on = was_thrown && sees && command.linear_mps > 0.0;
    if (command.linear_mps > 0.0 && sees) {
      pose = motion::Advance(pose, {kStep_m, 0.0});
      ++walked;
    } else {
      pose = motion::Advance(pose, {0.0, command.angular_radps / kFrames_hz});
      thrown.facing_rad += command.angular_radps / kFrames_hz;
    }
    if (walked == kThrownAt && !was_thrown) {
      was_thrown = true;
      thrown.facing_rad = thrown_rad;
    }
    if (was_thrown) {
      thrown.furthest_rad = std::max(thrown.furthest_rad, std::abs(thrown.facing_rad - thrown_rad));
    }
  }
  return thrown;
}

TEST(ReplaySessionLookingAround, FindsThePathAgainOnEitherSide) {
  for (const double thrown_rad : {0.6, -0.6}) {
    const Thrown thrown = ThrowBy(thrown_rad, 1.0);
    EXPECT_TRUE(thrown.drove_on) << thrown_rad << ": " << thrown.last.reason;
    EXPECT_FALSE(thrown.drove_astray) << thrown_rad;
  }
}

TEST(ReplaySessionLookingAround, GivesUpWhereItSeesNothingAndFacesWhereItDid) {
  const Thrown thrown = ThrowBy(2.5, 1.0);
  EXPECT_FALSE(thrown.drove_on || thrown.drove_astray);
  EXPECT_EQ(thrown.last.state, ReplayState::kLost);
  EXPECT_THAT(thrown.last.reason, HasSubstr("nor is it found 57 degrees to either side"));
  EXPECT_TRUE(Stands(thrown.last));
  EXPECT_NEAR(thrown.furthest_rad, 1.0, 0.1);
  EXPECT_NEAR(thrown.facing_rad, 2.5, 0.1);
}

TEST(ReplaySessionLookingAround, StandsIfItIsNotToTurn) {
  const Thrown thrown = ThrowBy(0.6, 0.0);
  EXPECT_FALSE(thrown.drove_on || thrown.drove_astray);
  EXPECT_EQ(thrown.last.state, ReplayState::kLost);
  EXPECT_EQ(thrown.furthest_rad, 0.0);
}

constexpr int kTurnsAt = 45;  // of the walk's frames
constexpr int kTurnsAgainAt = 15;
constexpr int kEndsAt = 55;

// Along the walk, back again most of it, and on: at which frame of it the robot is, one by one.
std::vector<int> ThereAndBack() {
  std::vector<int> at;
  for (int i = 0; i < kTurnsAt; ++i) at.push_back(i);
  for (int i = kTurnsAt; i > kTurnsAgainAt; --i) at.push_back(i);
  for (int i = kTurnsAgainAt; i <= kEndsAt; ++i) at.push_back(i);
  return at;
}

std::vector<route::Segment> TaughtThereAndBack() {
  TeachSession session;
  std::vector<route::Segment> segments;
  const std::vector<int> at = ThereAndBack();
  const auto keep = [&](std::optional<route::Segment> segment) {
    if (segment) segments.push_back(std::move(*segment));
  };
  for (std::size_t i = 0; i < at.size(); ++i) {
    auto step = session.Observe({StampOf(static_cast<int>(i)),
                                 Walk()[static_cast<std::size_t>(at[i])], PoseAt(at[i], true)});
    EXPECT_TRUE(step);
    keep(std::move(step->finished));
  }
  keep(session.Finish());
  return segments;
}

TEST(ReplaySessionReverse, DrivesBackwardsWhereItWasTaughtTo) {
  const std::vector<route::Segment> segments = TaughtThereAndBack();
  ReplaySession session = SessionOn(segments);
  ReplayStep last;
  double place_m = 0.0;
  double furthest_m = 0.0;  // before it first drives back
  double nearest_m = 9.0;   // after that
  double along_m = 0.0;
  for (int i = 0; i < 600 && last.state != ReplayState::kArrived; ++i) {
    const auto picture = static_cast<std::size_t>(
        std::clamp(std::lround(place_m / kStep_m), 0L, static_cast<long>(kFrames - 1)));
    const double seen_m = kStep_m * static_cast<double>(picture);
    const auto step =
        session.Observe({StampOf(i), Walk()[picture], motion::Pose2{seen_m, 0.0, 0.0}});
    ASSERT_TRUE(step);
    last = *step;
    ASSERT_TRUE(last.state == ReplayState::kFollowing || last.state == ReplayState::kArrived)
        << i << ": " << ToString(last.state) << ", " << last.reason;
    EXPECT_GE(last.along_m.value_or(0.0), along_m - 0.1) << "along the route it comes on";
    along_m = last.along_m.value_or(0.0);
    EXPECT_NEAR(session.known_m() * last.believed->place, along_m, 0.3) << i;
    place_m += last.command.linear_mps / kFrames_hz;
    if (last.command.linear_mps < 0.0) nearest_m = std::min(nearest_m, place_m);
    if (nearest_m > 8.0) furthest_m = std::max(furthest_m, place_m);
  }
  EXPECT_EQ(last.state, ReplayState::kArrived) << last.reason;
  EXPECT_NEAR(furthest_m, kStep_m * kTurnsAt, 0.12);
  EXPECT_NEAR(nearest_m, kStep_m * kTurnsAgainAt, 0.12);
  EXPECT_NEAR(place_m, kStep_m * kEndsAt, 0.12);
}

TEST(ReplaySessionReverse, WhoDoesNotDriveBackwardsStandsBeforeItAndSaysSo) {
  const std::vector<route::Segment> segments = TaughtThereAndBack();
  for (const bool odometry : {true, false}) {
    ReplayMethodOptions options;
    if (odometry) options.method = ReplayMethod::kPaper;
    ReplaySession session = SessionOn(segments, options);
    ReplayStep last;
    int frame = 0;
    for (int i = 0; i < 4 * kFrames && last.state != ReplayState::kLost; ++i) {
      if (last.command.linear_mps > 0.0) frame = std::min(frame + 1, kFrames - 1);
      const auto step = session.Observe(
          {StampOf(i), Walk()[static_cast<std::size_t>(frame)], PoseAt(frame, odometry)});
      ASSERT_TRUE(step);
      last = *step;
      EXPECT_GE(last.command.linear_mps, 0.0);
    }
    EXPECT_EQ(last.state, ReplayState::kLost);
    EXPECT_TRUE(Stands(last));
    EXPECT_THAT(last.reason, HasSubstr("is driven backwards here"));
    EXPECT_NEAR(frame, kTurnsAt, 18);
  }
}

TEST(ReplaySessionByViews, ARobotThatWasPutAtTheEndIsNotDrivenPastIt) {
  ReplayMethodOptions options;
  options.anywhere = true;
  ReplaySession session = SessionOn(Taught(false), options);
  ReplayStep last;
  double commanded_m = 0.0;
  for (int i = 0; i < 300; ++i) {
    const int frame = kFrames - 2 + i % 2;  // of a camera that shakes
    const auto step =
        session.Observe({StampOf(i), Walk()[static_cast<std::size_t>(frame)], std::nullopt});
    ASSERT_TRUE(step);
    EXPECT_NE(step->state, ReplayState::kArrived);
    commanded_m += step->command.linear_mps / kFrames_hz;
    last = *step;
  }
  EXPECT_LT(commanded_m, 0.1);
  EXPECT_EQ(last.state, ReplayState::kLost);
  EXPECT_THAT(last.reason, HasSubstr("looks like the route's end"));
}

}  // namespace
}  // namespace trailcast::agent
