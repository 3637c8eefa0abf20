#include "agent/session/src/features/starter.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace trailcast::agent {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

constexpr int kWidth_px = 320;
constexpr double kFrame_s = 0.1;

// This is a robot before a grey wall, on a route of three metres that shows nothing, either.
class BeforeAWall {
 public:
  explicit BeforeAWall(const ReplayMethodOptions& options = {})
      : look_around_(options.look_around_rad),
        starter_(options, kWidth_px, route_, front_end_, place_, search_, look_around_) {
    for (std::uint32_t i = 0; i < 3; ++i) {
      route::Segment segment;
      segment.index = SegmentIndex(i);
      segment.has_odometry = true;
      segment.length_m = 1.0;
      segment.duration_s = 2.0;
      place_.Learn(segment);
      route_.Add(std::move(segment));
    }
    if (options.anywhere) {
      place_.StartAnywhere();
    } else {
      place_.StartAt(0.0, 0.3);
    }
    search_.Open(*Frame().frame);
  }

  [[nodiscard]] Starter& starter() { return starter_; }

  // Lets so many frames pass in which it does not begin to follow. Returns the last one's outcome.
  [[nodiscard]] Next Stand(int frames) {
    Next next;
    for (int i = 0; i < frames; ++i) {
      auto outcome = starter_.Step(Frame());
      EXPECT_TRUE(std::holds_alternative<Next>(outcome)) << i;
      if (auto* stands = std::get_if<Next>(&outcome)) next = std::move(*stands);
    }
    return next;
  }
  [[nodiscard]] std::variant<Begun, Next> Step() { return starter_.Step(Frame()); }

 private:
  [[nodiscard]] FrameInput Frame() {
    FrameInput seen;
    seen.frame = &wall_;
    seen.measured = seen.driven = motion::OdometryIncrement{};
    seen.dt_s = seen.looked_s = kFrame_s;
    front_end_.Track(seen, FollowedFor::kPlace);
    return seen;
  }

  image::GrayImage wall_{kWidth_px, 240, std::vector<std::uint8_t>(kWidth_px * 240, 128)};
  KnownRoute route_{3};
  FrontEnd front_end_{{}, true};
  Localiser place_{kWidth_px};
  FeatureSearch search_{true, kWidth_px, front_end_, place_};
  LookingAround look_around_;
  Starter starter_;
};

TEST(Starter, BeginsAtTheBeginningWithoutLooking) {
  BeforeAWall robot;
  EXPECT_FALSE(robot.starter().seeks_start());
  const auto outcome = robot.Step();
  ASSERT_TRUE(std::holds_alternative<Begun>(outcome));
  const Begun& begun = std::get<Begun>(outcome);
  ASSERT_TRUE(begun.follower);
  EXPECT_EQ(begun.follower->segment().index, SegmentIndex(0));
  EXPECT_FALSE(begun.sought);
  EXPECT_FALSE(begun.recognised);
}

TEST(Starter, SaysWhyItStandsWhereItWasNotLeft) {
  BeforeAWall robot;
  robot.starter().GoOnFrom({1.5, 1.0});
  EXPECT_TRUE(robot.starter().seeks_start());
  const Next looks = robot.Stand(1);
  EXPECT_EQ(looks.verdict.trust, Trust::kSeeking);
  EXPECT_EQ(looks.verdict.reason, "looks whether it is where it was left, 1.5 m along the route");
  const Next gives_up = robot.Stand(40);  // three rounds of a dozen places
  EXPECT_EQ(gives_up.state(), ReplayState::kLost);
  EXPECT_THAT(gives_up.verdict.reason, HasSubstr("--from-start"));
}

TEST(Starter, LooksAnywhereIfItIsNotWhereItWasLeftAndMay) {
  BeforeAWall robot({.else_anywhere = true});
  robot.starter().GoOnFrom({1.5, 1.0});
  const Next anywhere = robot.Stand(40);
  EXPECT_EQ(anywhere.verdict.trust, Trust::kSeeking);
  EXPECT_THAT(anywhere.verdict.reason,
              StartsWith("it is not where it was left: looks where on the route it is"));
  EXPECT_TRUE(robot.starter().seeks_start());
}

TEST(Starter, GivesUpWhereNothingIsRecognised) {
  BeforeAWall robot({.anywhere = true});
  EXPECT_EQ(robot.Stand(30).verdict.trust, Trust::kSeeking);
  const Next lost = robot.Stand(2);
  EXPECT_EQ(lost.state(), ReplayState::kLost);
  EXPECT_EQ(lost.step.command, motion::VelocityCommand{});
  EXPECT_THAT(lost.verdict.reason, HasSubstr("the route is not recognised for 3.2 s"));
}

TEST(Starter, LooksAroundBeforeItGivesUp) {
  BeforeAWall robot({.anywhere = true, .look_around_rad = 1.0});
  EXPECT_EQ(robot.Stand(30).verdict.trust, Trust::kSeeking);
  const Next turns = robot.Stand(2);
  EXPECT_EQ(turns.verdict.trust, Trust::kLooking);
  EXPECT_GT(turns.step.command.angular_radps, 0.0);
  EXPECT_THAT(turns.verdict.reason, StartsWith("turns on the spot to look for the path"));
}

TEST(Starter, LooksForItselfOnceIfItNeverWasOnItsPath) {
  BeforeAWall robot({.else_anywhere = true});
  const auto seeks = robot.starter().LookElsewhere(std::nullopt);
  ASSERT_TRUE(seeks);
  EXPECT_EQ(seeks->trust, Trust::kSeeking);
  EXPECT_EQ(seeks->reason, "it is not at the route's start: looks where on the route it is");
  EXPECT_TRUE(robot.starter().seeks_start());
  EXPECT_FALSE(robot.starter().LookElsewhere(std::nullopt)) << "it looks there already";
}

TEST(Starter, LooksForItselfAgainWheneverItHasLostItsPath) {
  BeforeAWall robot({.else_anywhere = true});
  for (int i = 0; i < 2; ++i) {
    const auto seeks = robot.starter().LookElsewhere(Starter::LostPath{"too dark", {}});
    ASSERT_TRUE(seeks);
    EXPECT_THAT(seeks->reason, StartsWith("it has lost its path (too dark): "));
    EXPECT_FALSE(robot.starter().seeks_start()) << "it was not put there";
    EXPECT_THAT(robot.Stand(1).verdict.reason, StartsWith(seeks->reason));
  }
}

TEST(Starter, LooksNowhereElseIfItMayNot) {
  BeforeAWall robot;
  EXPECT_FALSE(robot.starter().LookElsewhere(std::nullopt));
  EXPECT_FALSE(robot.starter().LookElsewhere(Starter::LostPath{"too dark", {}}));
  BeforeAWall printed({.method = ReplayMethod::kPaper, .else_anywhere = true});
  EXPECT_FALSE(printed.starter().LookElsewhere(Starter::LostPath{"too dark", {}}))
      << "a printed method does not tell its place by features";
}

// Returns what a camera of this focal length sees all round.
std::vector<route::TrackedFeature> SeenAt(double heading_rad, double focal_px) {
  std::vector<route::TrackedFeature> seen;
  for (int id = 0; id < 30; ++id) {
    const double u_px = focal_px * std::tan(heading_rad - 0.4 + 0.8 * id / 30);
    seen.push_back({id, u_px, 0.2 * u_px});
  }
  return seen;
}

TEST(LensTurn, TellsTheFocalLengthByALittleTurnToEitherSide) {
  constexpr double kFocal_px = 400.0;
  LensTurn lens(2.0);
  double heading_rad = 0.0;
  double furthest_rad = 0.0;
  for (double turned_rad = 0.0; lens.Turn(SeenAt(heading_rad, kFocal_px), 320, turned_rad, 0.1);) {
    ASSERT_TRUE(lens.begun());
    ASSERT_TRUE(lens.turns());
    turned_rad = 0.1 * lens.turn_rate_radps();
    heading_rad += turned_rad;
    furthest_rad = std::max(furthest_rad, std::abs(heading_rad));
  }
  EXPECT_NEAR(furthest_rad, 0.2, 0.06);
  ASSERT_TRUE(lens.focal());
  EXPECT_NEAR(lens.focal()->px, kFocal_px, 0.05 * kFocal_px);
  EXPECT_FALSE(lens.Turn(SeenAt(heading_rad, kFocal_px), 320, 0.0, 0.1)) << "it is known now";
}

TEST(LensTurn, DoesNotTurnForWhatIsKnownNorIfItMayNot) {
  LensTurn known(2.0);
  known.Know(replay::FocalLength{300.0, 0.1});
  EXPECT_FALSE(known.Turn(SeenAt(0.0, 300.0), 320, 0.0, 0.1));
  LensTurn still(0.0);
  EXPECT_FALSE(still.Turn(SeenAt(0.0, 300.0), 320, 0.0, 0.1));
  EXPECT_FALSE(still.focal());
}

}  // namespace
}  // namespace trailcast::agent
