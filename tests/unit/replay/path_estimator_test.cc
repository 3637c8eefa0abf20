#include "services/replay/path_estimator.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <tuple>
#include <vector>

#include "services/replay/lane_keeping.h"
#include "services/replay/path_follower.h"
#include "tests/support/taught_segment.h"

namespace trailcast::replay {
namespace {

const test::LandmarkScene kCorridor = test::LandmarkScene::Corridor(4.0, 16.0, 90, 5);
constexpr double kFrame_s = 1.0 / 30.0;

// An estimator that was told it has come a metre along the run.
PathEstimator AMetreAlong(const test::TaughtRun& run, double magnification = 1.0) {
  PathEstimator estimator(320, magnification);
  estimator.Begin(run.segment);
  estimator.Predict({1.0, 0.0});
  return estimator;
}

// Returns what the estimator makes of one look from a known place beside the path.
PathOffset LookFrom(const motion::Pose2& pose, double magnification = 1.0, double roll_rad = 0.0) {
  const auto run = test::TeachArcs(kCorridor, {}, {{2.0, 0.0}});
  PathEstimator estimator = AMetreAlong(run, magnification);
  for (int i = 0; i < 5; ++i) {
    EXPECT_GE(estimator
                  .Update(test::Matched(kCorridor, run, pose, {.roll_rad = roll_rad},
                                        magnification * test::LandmarkScene::kFocal_px))
                  .agreeing,
              10);
  }
  return estimator.offset();
}

TEST(PathEstimator, SaysZeroOnThePath) {
  const PathOffset offset = LookFrom({1.0, 0.0, 0.0});
  EXPECT_NEAR(offset.left_m, 0.0, 0.01);
  EXPECT_NEAR(offset.heading_rad, 0.0, 0.005);
  EXPECT_NEAR(offset.along_m, 1.0, 0.04);  // tracks are straight between knots, in truth they bend
}

TEST(PathEstimator, TellsSidewaysFromRotation) {
  const PathOffset aside = LookFrom({1.0, 0.15, 0.0});
  EXPECT_NEAR(aside.left_m, 0.15, 0.04);
  const PathOffset turned = LookFrom({1.0, 0.0, 0.05});
  EXPECT_NEAR(turned.left_m, 0.0, 0.04);
}

// Counted along another segment, round a corner, it is where it was, and knows that as well.
TEST(PathEstimator, IsWhereItIsWhicheverSegmentItIsCountedAlong) {
  const auto run = test::TeachArcs(kCorridor, {}, {{2.0, 0.0}});
  PathEstimatorOptions options;
  options.camera_ahead_m = 0.0;  // its camera is where its axle is
  options.told_ahead_m = 1e-4;
  PathEstimator estimator(320, 1.0, options);
  estimator.Restart(run.segment, 1.0);
  for (int i = 0; i < 5; ++i) {
    (void)estimator.Update(
        test::Matched(kCorridor, run, {1.0, 0.15, 0.05}, {}, test::LandmarkScene::kFocal_px));
  }
  const PathOffset before = estimator.offset();
  const motion::Pose2 there{1.2, -0.1, 0.5};
  estimator.CountAlong(run.segment, 0.7, there);
  const PathOffset after = estimator.offset();
  const double ahead_m = before.along_m - there.x_m;
  const double left_m = before.left_m - there.y_m;
  EXPECT_NEAR(after.along_m, 0.7 + std::cos(0.5) * ahead_m + std::sin(0.5) * left_m, 1e-9);
  EXPECT_NEAR(after.left_m, -std::sin(0.5) * ahead_m + std::cos(0.5) * left_m, 1e-9);
  EXPECT_NEAR(after.heading_rad, before.heading_rad - 0.5, 1e-9);
  EXPECT_NEAR(std::hypot(after.left_sigma_m, after.along_sigma_m),
              std::hypot(before.left_sigma_m, before.along_sigma_m), 1e-3);
  estimator.CountAlong(run.segment, before.along_m, {after.along_m, after.left_m, -0.5});
  EXPECT_NEAR(estimator.offset().along_m, before.along_m, 1e-9);
  EXPECT_NEAR(estimator.offset().left_m, 0.0, 1e-9);
  EXPECT_NEAR(estimator.offset().heading_rad, before.heading_rad, 1e-9);
}

// A robot whose camera is 0.3 m ahead of its axle, on the path in a bend to the left: the camera
// is outside of it.
TEST(PathEstimator, KnowsTheAxleOfACameraAhead) {
  constexpr double kAhead_m = 0.3;
  constexpr double kTurn_radpm = 0.4;
  const auto run = test::TeachArcs(kCorridor, {}, {{1.6, 1.6 * kTurn_radpm}});
  const auto on_path = [](double along_m) {
    const double heading_rad = kTurn_radpm * along_m;
    return motion::Pose2{std::sin(heading_rad) / kTurn_radpm,
                         (1.0 - std::cos(heading_rad)) / kTurn_radpm, heading_rad};
  };
  PathEstimatorOptions options;
  options.camera_ahead_m = kAhead_m;
  PathEstimator estimator(320, 1.0, options);
  estimator.Restart(run.segment, kAhead_m);
  PathOffset offset;
  for (double along_m = 0.0; along_m < 1.1; along_m += 0.02) {
    const motion::Pose2 camera = motion::Compose(on_path(along_m), {kAhead_m, 0.0, 0.0});
    estimator.Update(test::Matched(kCorridor, run, camera));
    offset = estimator.offset();
    estimator.Predict({0.02, 0.02 * kTurn_radpm});
    if (along_m < 0.3) continue;
    EXPECT_NEAR(offset.along_m, along_m, 0.04);
    EXPECT_NEAR(offset.left_m, 0.0, 0.025) << along_m;
    EXPECT_NEAR(offset.heading_rad, 0.0, 0.05) << along_m;
  }
}

// A robot that drives an S of two bends with its axle upon it, and was not told where its camera
// is.
TEST(PathEstimator, LearnsInBendsHowFarItsCameraIsAhead) {
  constexpr double kTurn_radpm = 0.4;
  for (const double ahead_m : {0.0, 0.3, -0.2}) {
    PathEstimator estimator(320, 1.0);
    std::vector<test::TaughtRun> runs;
    for (int segment = 0; segment < 4; ++segment) {
      const motion::Pose2 scout = runs.empty() ? motion::Pose2{} : runs.back().end;
      const double turn_rad = segment < 2 ? kTurn_radpm : -kTurn_radpm;
      runs.push_back(test::TeachArcs(kCorridor, scout, {{1.0, turn_rad}}));
    }
    estimator.StartAt(runs[0].segment);
    std::size_t segment = 0;
    motion::Pose2 robot;
    for (int i = 0; i < 200; ++i) {
      if (estimator.camera_along_m() >= 1.0 && segment < 3) {
        estimator.Begin(runs[++segment].segment);
      }
      const motion::Pose2 camera = motion::Compose(robot, {ahead_m, 0.0, 0.0});
      estimator.Update(test::Matched(kCorridor, runs[segment], camera));
      const double turn_rad = 0.02 * (i < 100 ? kTurn_radpm : -kTurn_radpm);
      robot = motion::Advance(robot, {0.02, turn_rad});
      estimator.Predict({0.02, turn_rad});
    }
    EXPECT_NEAR(estimator.camera_ahead_m(), ahead_m, 0.12);
    EXPECT_NEAR(estimator.offset().along_m, 1.0, 0.06) << ahead_m;
    EXPECT_NEAR(estimator.offset().left_m, 0.0, 0.03) << ahead_m;
  }
}

TEST(PathEstimator, ASpotTurnSwingsACameraAheadAndNotTheAxle) {
  PathEstimatorOptions options;
  options.camera_ahead_m = 0.3;
  PathEstimator estimator(320, 1.0, options);
  const auto run = test::TeachArcs(kCorridor, {}, {{2.0, 0.0}});
  estimator.Restart(run.segment, 0.3);
  estimator.TurnPath(1.5);
  for (int i = 0; i < 30; ++i) estimator.Predict({0.0, 0.05});
  EXPECT_NEAR(estimator.offset().along_m, 0.0, 0.02);
  EXPECT_NEAR(estimator.offset().left_m, 0.0, 0.02);
  EXPECT_NEAR(estimator.offset().heading_rad, 0.0, 0.01);
  EXPECT_NEAR(estimator.camera_along_m(), 0.3, 0.02);
}

struct Mishap {
  double knock_rad = 0.0;  // the camera's mount, to the left
  double left_grip = 1.0;  // of the left wheel, for a second
  double frame_s = kFrame_s;
};

// How far off a straight path a robot gets, in closed loop, to which that happens half way.
double FarthestAfter(const Mishap& mishap) {
  constexpr double kWheelBase_m = 0.34;
  constexpr double kSpeed_mps = 0.4;
  const test::LandmarkScene scene = test::LandmarkScene::Corridor(2.0, 24.0, 240, 7);
  PathEstimator estimator(320, 1.0);
  motion::Pose2 robot;
  double farthest_m = 0.0;
  double slipped_s = 0.0;
  for (int segment = 0; segment < 8; ++segment) {
    const auto run = test::TeachArcs(scene, {1.0 * segment, 0.0, 0.0}, {{1.0, 0.0}});
    estimator.Begin(run.segment);
    while (estimator.offset().along_m < 1.0) {
      const bool happened = robot.x_m > 4.2;
      const double mount_rad = happened ? mishap.knock_rad : 0.0;
      estimator.Update(test::Matched(scene, run, motion::Compose(robot, {0.0, 0.0, mount_rad})));
      const double turn_rate = LaneKeepingTurnRate(estimator.offset(), 0.0, kSpeed_mps);
      const motion::OdometryIncrement moved{kSpeed_mps * mishap.frame_s,
                                            turn_rate * mishap.frame_s};
      const bool slips = happened && slipped_s < 1.0;
      if (slips) slipped_s += mishap.frame_s;
      const double left_m = moved.distance_m - 0.5 * kWheelBase_m * moved.heading_change_rad;
      const double lost_m = slips ? (1.0 - mishap.left_grip) * left_m : 0.0;
      robot = motion::Advance(robot, {moved.distance_m - 0.5 * lost_m,
                                      moved.heading_change_rad + lost_m / kWheelBase_m});
      estimator.Predict(moved);
      farthest_m = std::max(farthest_m, std::abs(robot.y_m));
      if (std::abs(robot.y_m) > 2.0) return farthest_m;
    }
  }
  return farthest_m;
}

TEST(PathEstimator, IsNotLedFarByAMountThatIsKnockedOnTheWay) {
  EXPECT_LT(FarthestAfter({}), 0.03);
  for (const double knock_rad : {0.09, -0.09, 0.05}) {
    EXPECT_LT(FarthestAfter({.knock_rad = knock_rad}), 0.06) << knock_rad;
  }
}

TEST(PathEstimator, IsNotLedFarByAWheelThatSlips) {
  for (const double frame_s : {kFrame_s, 0.1, 0.2}) {
    for (const double grip : {0.3, 0.6}) {
      EXPECT_LT(FarthestAfter({.left_grip = grip, .frame_s = frame_s}), 0.2)
          << grip << " " << frame_s;
    }
  }
}

TEST(PathEstimator, SeesProgressThatOdometryMissed) {
  EXPECT_NEAR(LookFrom({1.2, 0.0, 0.0}).along_m, 1.2, 0.05);
  EXPECT_NEAR(LookFrom({0.8, 0.0, 0.0}).along_m, 0.8, 0.05);
}

TEST(PathEstimator, BearsRollAndAnotherMagnification) {
  for (const double magnification : {0.6, 1.0, 1.8}) {
    const PathOffset offset = LookFrom({1.0, 0.1, 0.0}, magnification, 0.04);
    EXPECT_NEAR(offset.left_m, 0.1, 0.05) << "magnification " << magnification;
  }
}

// Returns what is seen there on the path, with a fifth of it mismatched.
std::vector<route::TrackedFeature> WithMismatches(const test::TaughtRun& run) {
  auto seen = test::Matched(kCorridor, run, {1.0, 0.0, 0.0});
  for (std::size_t i = 0; i < seen.size() / 5; ++i) seen[i].u_px += 60.0;
  return seen;
}

TEST(PathEstimator, PassesOverMismatches) {
  const auto run = test::TeachArcs(kCorridor, {}, {{2.0, 0.0}});
  PathEstimator estimator = AMetreAlong(run);
  const auto seen = WithMismatches(run);
  ASSERT_GE(seen.size(), 20U);
  const Agreement agreement = estimator.Update(seen);
  EXPECT_EQ(agreement.agreeing, static_cast<int>(seen.size() - seen.size() / 5));
  EXPECT_EQ(agreement.rejected, static_cast<int>(seen.size() / 5));
  EXPECT_GT(agreement.rejected_by_px, PathEstimatorOptions{}.outlier_px);
  EXPECT_NEAR(estimator.offset().left_m, 0.0, 0.03);
}

// Something that goes along with the camera is none of the route's features.
TEST(PathEstimator, IsNotHeldBackByAHandfulOfMismatches) {
  const auto run = test::TeachArcs(kCorridor, {}, {{2.0, 0.0}});
  PathEstimator estimator = AMetreAlong(run);
  auto seen = test::Matched(kCorridor, run, {1.0, 0.0, 0.0});
  for (int i = 0; i < 20; ++i) static_cast<void>(estimator.Update(seen));
  seen.resize(3);
  constexpr double kTurn_rad = 0.01;
  constexpr int kFrames = 30;
  for (int i = 0; i < kFrames; ++i) {
    estimator.Predict({0.01, kTurn_rad});
    static_cast<void>(estimator.Update(seen));
  }
  EXPECT_NEAR(estimator.offset().heading_rad, kFrames * kTurn_rad, 0.03);
}

// Being carried is the rarest of explanations.
TEST(PathEstimator, AViewFromElsewhereThatDoesNotLastIsNoProofOfBeingCarried) {
  const auto run = test::TeachArcs(kCorridor, {}, {{2.0, 0.0}});
  PathEstimator estimator = AMetreAlong(run);
  for (int i = 0; i < 20; ++i) {
    static_cast<void>(estimator.Update(test::Matched(kCorridor, run, {1.0, 0.0, 0.0})));
  }
  for (int i = 0; i < 30; ++i) {
    const bool elsewhere = i % 10 < 6;
    const double along_m = 1.0 + 0.02 * i;
    const auto seen = test::Matched(kCorridor, run, {along_m, elsewhere ? 1.2 : 0.0, 0.0});
    EXPECT_FALSE(estimator.Update(seen).carried_left_m) << i;
    estimator.Predict({0.02, 0.0});
  }
  EXPECT_NEAR(estimator.offset().left_m, 0.0, 0.15);
}

// Sure of its place on the path, then at another without having driven there.
TEST(PathEstimator, FindsItselfAgainWhereItWasCarried) {
  const auto run = test::TeachArcs(kCorridor, {}, {{2.0, 0.0}});
  for (const double carried_m : {-1.2, 0.7, 1.2}) {
    PathEstimator estimator(320, 1.0);
    estimator.Begin(run.segment);
    estimator.Predict({0.6, 0.0});
    for (int i = 0; i < 20; ++i) {
      const auto seen = test::Matched(kCorridor, run, {0.6 + 0.02 * i, 0.0, 0.0});
      EXPECT_FALSE(estimator.Update(seen).carried_left_m);
      estimator.Predict({0.02, 0.0});
    }
    EXPECT_LT(estimator.offset_sigma_m(), 0.05);
    std::optional<double> found_m;
    double along_m = 1.0;
    while (!found_m && along_m < 1.5) {
      const auto seen = test::Matched(kCorridor, run, {along_m, carried_m, 0.0});
      found_m = estimator.Update(seen).carried_left_m;
      estimator.Predict({0.02, 0.0});
      along_m += 0.02;
    }
    ASSERT_TRUE(found_m) << carried_m;
    EXPECT_NEAR(estimator.offset().left_m, carried_m, 0.15);
    EXPECT_NEAR(*found_m, carried_m, 0.3);
  }
}

// All looks together tell it, though every third of those that are asked contradicts.
TEST(PathEstimator, FindsItselfAgainThoughALookNowAndThenContradicts) {
  const auto run = test::TeachArcs(kCorridor, {}, {{2.0, 0.0}});
  PathEstimator estimator = AMetreAlong(run);
  for (int i = 0; i < 20; ++i) {
    static_cast<void>(estimator.Update(test::Matched(kCorridor, run, {1.0, 0.0, 0.0})));
  }
  std::optional<double> found_m;
  for (int i = 0; i < 30 && !found_m; ++i) {
    const bool contradicts = i / 5 % 3 == 2;
    const double along_m = 1.0 + 0.02 * i;
    const auto seen = test::Matched(kCorridor, run, {along_m, contradicts ? 0.0 : 1.2, 0.0});
    found_m = estimator.Update(seen).carried_left_m;
    estimator.Predict({0.02, 0.0});
  }
  ASSERT_TRUE(found_m);
  EXPECT_NEAR(estimator.offset().left_m, 1.2, 0.15);
}

TEST(PathEstimator, TakesAFewMismatchesForNothingMore) {
  const auto run = test::TeachArcs(kCorridor, {}, {{2.0, 0.0}});
  PathEstimator estimator = AMetreAlong(run);
  const auto seen = WithMismatches(run);
  for (int i = 0; i < 30; ++i) EXPECT_FALSE(estimator.Update(seen).carried_left_m);
  EXPECT_NEAR(estimator.offset().left_m, 0.0, 0.03);
}

// Far off the path the offset is known by depths that err by a share of it: it must stay open to
// correction from look to look. On the path that costs nothing.
TEST(PathEstimator, IsLessSureTheFurtherOffItIs) {
  const auto run = test::TeachArcs(kCorridor, {}, {{2.0, 0.0}});
  const auto sigma_after_driving = [&](double share) {
    PathEstimatorOptions options;
    options.left_noise_share = share;
    PathEstimator estimator(320, 1.0, options);
    estimator.Begin(run.segment);
    estimator.Predict({0.8, 0.0});
    const auto far_off = test::Matched(kCorridor, run, {0.8, 1.0, 0.0});
    for (int i = 0; i < 20; ++i) std::ignore = estimator.Update(far_off);
    EXPECT_NEAR(estimator.offset().left_m, 1.0, 0.2);
    estimator.Predict({0.5, 0.0});
    return estimator.offset_sigma_m();
  };
  const double share = PathEstimatorOptions{}.left_noise_share;
  EXPECT_GT(sigma_after_driving(share), 0.9 * share * std::sqrt(0.5));
  EXPECT_LT(sigma_after_driving(0.0), 0.1);
}

// One look after the other errs in the same way.
TEST(PathEstimator, IsNoSurerHoweverLongItStands) {
  const auto run = test::TeachArcs(kCorridor, {}, {{2.0, 0.0}});
  PathEstimator estimator = AMetreAlong(run);
  const auto seen = test::Matched(kCorridor, run, {1.0, 0.1, 0.0});
  estimator.Update(seen);
  const PathOffset first = estimator.offset();
  for (int i = 0; i < 300; ++i) {
    estimator.Predict({0.0, 0.0});
    estimator.Update(seen);
  }
  EXPECT_GE(estimator.offset_sigma_m(), 0.99 * first.left_sigma_m);
  EXPECT_NEAR(estimator.offset().left_m, 0.1, 0.02);
  // So it soon sees that it was carried.
  for (int i = 0; i < 20; ++i) {
    estimator.Predict({0.02, 0.0});
    estimator.Update(test::Matched(kCorridor, run, {1.02 + 0.02 * i, -1.2, 0.0}));
  }
  EXPECT_NEAR(estimator.offset().left_m, -1.2, 0.1);
}

// Begun on the way, before a wall: each feature is found a little beside where it was taught, and
// stays so. Look by look that must not add up to another camera further back.
TEST(PathEstimator, IsNotLedBackByWhatIsWrongWithEachFeatureForGood) {
  const test::LandmarkScene wall = test::LandmarkScene::Corridor(6.0, 6.4, 60, 5);
  const auto run = test::TeachArcs(wall, {}, {{2.0, 0.0}});
  for (unsigned seed = 1; seed <= 20; ++seed) {
    std::mt19937 random(seed);
    std::vector<double> wrong_px(2 * run.segment.features.size());
    for (double& px : wrong_px) px = 2.0 * static_cast<double>(random()) / 4294967295.0 - 1.0;
    PathEstimator estimator(320, 1.0);
    estimator.Begin(run.segment);
    estimator.Predict({0.5, 0.0});
    estimator.BeUnsureWhereAlong({.along_sigma_m = 1.0});
    double along_m = 0.5;
    for (; along_m < 1.5; along_m += 0.008) {
      auto seen = test::Matched(wall, run, {along_m, 0.0, 0.0});
      for (route::TrackedFeature& feature : seen) {
        feature.u_px += wrong_px[2 * static_cast<std::size_t>(feature.id)];
        feature.v_px += wrong_px[2 * static_cast<std::size_t>(feature.id) + 1];
      }
      estimator.Update(seen);
      estimator.Predict({0.008, 0.0});
    }
    EXPECT_NEAR(estimator.magnification(), 1.0, 0.02) << seed;
    EXPECT_NEAR(estimator.offset().along_m, along_m, 0.1) << seed;
  }
}

TEST(PathEstimator, FollowsOdometryWithoutFeatures) {
  const auto run = test::TeachArcs(kCorridor, {}, {{1.0, 0.3}});
  PathEstimator estimator(320, 1.0);
  estimator.Begin(run.segment);
  for (int i = 0; i < 50; ++i) {
    estimator.Predict({0.01, 0.003});
    EXPECT_EQ(estimator.Update({}).agreeing, 0);
  }
  EXPECT_NEAR(estimator.offset().along_m, 0.5, 0.01);
  EXPECT_NEAR(estimator.offset().left_m, 0.0, 0.01);
  EXPECT_GT(estimator.offset_sigma_m(), 0.09);
}

TEST(LaneKeeping, GainsAreCriticallyDamped) {
  // L = 0.5 m: c1 = 4 /m, c2 = 4 /m^2 at 0.4 m/s.
  EXPECT_NEAR(LaneKeepingTurnRate({0.0, 0.1, 0.0}, 0.0, 0.4), -0.16, 1e-9);
  EXPECT_NEAR(LaneKeepingTurnRate({0.1, 0.0, 0.0}, 0.0, 0.4), -0.16, 1e-9);
  EXPECT_NEAR(LaneKeepingTurnRate({0.0, 0.0, 0.0}, 0.5, 0.4), 0.2, 1e-9);
}

TEST(LaneKeeping, NeverApproachesSteeperThanItsLimit) {
  const LaneKeepingOptions options;
  // Already heading for the path at the limit, from far away: straight on.
  EXPECT_NEAR(LaneKeepingTurnRate({5.0, -options.steepest_rad, 0.0}, 0.0, 0.4), 0.0, 1e-9);
}

// Drives a robot with a perfect base by the follower's commands over several segments.
motion::Pose2 Drive(const std::vector<test::TaughtRun>& runs, motion::Pose2 robot,
                    double magnification, double aside_m = 0.0) {
  PathFollower follower(320, magnification);
  motion::OdometryIncrement moved;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    route::Segment segment = runs[i].segment;
    segment.index = SegmentIndex(static_cast<std::uint32_t>(i));
    follower.Begin(segment);
    FollowStep step;
    for (int frame = 0; frame < 900 && !step.ended; ++frame) {
      step = follower.Step({test::Matched(kCorridor, runs[i], robot, {},
                                          magnification * test::LandmarkScene::kFocal_px),
                            moved,
                            {},
                            aside_m});
      if (step.ended) {
        moved = {};
        break;
      }
      moved = {step.command.linear_mps * kFrame_s, step.command.angular_radps * kFrame_s};
      robot = motion::Advance(robot, moved);
    }
    EXPECT_TRUE(step.ended) << "segment " << i;
  }
  return robot;
}

TEST(PathFollower, ReturnsToThePathAndEndsWhereTeachingEnded) {
  const auto first = test::TeachArcs(kCorridor, {}, {{1.5, 0.0}});
  const auto second = test::TeachArcs(kCorridor, first.end, {{1.0, 0.25}});
  const auto third = test::TeachArcs(kCorridor, second.end, {{1.0, -0.25}});
  for (const double magnification : {0.7, 1.0, 1.6}) {
    const motion::Pose2 end = Drive({first, second, third}, {-0.08, 0.1, -0.05}, magnification);
    EXPECT_NEAR(end.x_m, third.end.x_m, 0.08) << "magnification " << magnification;
    EXPECT_NEAR(end.y_m, third.end.y_m, 0.08) << "magnification " << magnification;
    EXPECT_NEAR(end.heading_rad, third.end.heading_rad, 0.08);
  }
}

TEST(PathFollower, DrivesBesideThePathWhereItIsTold) {
  const auto first = test::TeachArcs(kCorridor, {}, {{1.5, 0.0}});
  const auto second = test::TeachArcs(kCorridor, first.end, {{1.5, 0.3}});
  for (const double aside_m : {0.4, -0.4}) {
    const motion::Pose2 end = Drive({first, second}, {}, 1.0, aside_m);
    const motion::Pose2 beside = motion::Between(second.end, end);
    EXPECT_NEAR(beside.y_m, aside_m, 0.06);
    EXPECT_NEAR(beside.heading_rad, 0.0, 0.06);
  }
}

TEST(PathFollower, WantsTheNextSegmentWhenFewFeaturesAreLeft) {
  const auto run = test::TeachArcs(kCorridor, {}, {{2.0, 0.0}});
  PathFollower follower(320, 1.0);
  follower.Begin(run.segment);
  auto few = test::Matched(kCorridor, run, {1.2, 0.0, 0.0});
  few.resize(5);
  EXPECT_TRUE(follower.Step({few, motion::OdometryIncrement{1.2, 0.0}}).wants_next);
  EXPECT_FALSE(
      follower.Step({test::Matched(kCorridor, run, {1.2, 0.0, 0.0}), motion::OdometryIncrement{}})
          .wants_next);
}

}  // namespace
}  // namespace trailcast::replay
