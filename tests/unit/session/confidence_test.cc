#include "agent/session/confidence.h"

#include <gmock/gmock.h>

#include <utility>

namespace trailcast::agent {
namespace {

constexpr motion::OdometryIncrement kStep{0.02, 0.0};
constexpr int kTaught = 40;

// A robot on its way, frame by frame; `see` says how many of the segment's features agree.
class ConfidenceTest : public ::testing::Test {
 protected:
  Verdict See(int agreeing, int frames = 1,
              std::optional<motion::OdometryIncrement> moved = kStep) {
    Verdict verdict;
    for (int i = 0; i < frames; ++i) {
      Sighting seen{segment_,
                    taught_,
                    agreeing,
                    std::exchange(vanish_, 0),
                    in_picture_,
                    left_sigma_m_,
                    std::exchange(carried_off_, false)};
      seen.recognised = std::exchange(recognised_, false);
      seen.glimpsed = std::exchange(glimpsed_, false);
      seen.dt_s = dt_s_;
      verdict = confidence_.Judge(seen, moved);
    }
    return verdict;
  }
  void NextSegment(int taught) {
    ++segment_;
    taught_ = taught;
  }

  // So many features vanish in the next frame, in the middle of the picture.
  void Vanish(int features) { vanish_ = features; }

  Confidence confidence_;
  std::optional<int> in_picture_;
  std::optional<double> left_sigma_m_;
  std::uint32_t segment_ = 0;
  int taught_ = kTaught;
  int vanish_ = 0;
  bool carried_off_ = false;  // in the next frame
  bool recognised_ = false;   // the same
  bool glimpsed_ = false;     // the same
  double dt_s_ = 1.0 / 30.0;
};

TEST_F(ConfidenceTest, IsSureWhenEnoughFeaturesAgree) {
  const Verdict verdict = See(8);
  EXPECT_EQ(verdict.trust, Trust::kSure);
  EXPECT_EQ(verdict.reason, "");
}

TEST_F(ConfidenceTest, StandsAfterATurnUntilItIsSureOfTheWayOn) {
  See(20, 100);
  NextSegment(kTaught);
  confidence_.SeekAnew("the way on is not found");
  Verdict verdict = See(0, 89);
  EXPECT_EQ(verdict.trust, Trust::kSeeking);
  EXPECT_THAT(verdict.reason, ::testing::HasSubstr("the way on is not found: 0 of segment 1's 40"));
  EXPECT_EQ(See(8).trust, Trust::kSure);
  confidence_.SeekAnew("the way on is not found");
  EXPECT_EQ(See(0, 91).trust, Trust::kLost);
}

TEST_F(ConfidenceTest, SeeksForSecondsWhateverTheFrameRate) {
  for (const double rate_hz : {5.0, 15.0, 60.0}) {
    confidence_ = Confidence();
    dt_s_ = 1.0 / rate_hz;
    EXPECT_EQ(See(7, static_cast<int>(3.0 * rate_hz)).trust, Trust::kSeeking) << rate_hz;
    EXPECT_EQ(See(7).trust, Trust::kLost) << rate_hz;
  }
}

TEST_F(ConfidenceTest, SeeksTheRouteStartStandingAndIsLostWithoutIt) {
  EXPECT_EQ(See(7, 90).trust, Trust::kSeeking);
  const Verdict verdict = See(7);
  EXPECT_EQ(verdict.trust, Trust::kLost);
  EXPECT_EQ(verdict.reason,
            "the route's start is not found: 7 of segment 0's 40 features in view for 3.0 s; 8 "
            "are needed to be sure");
}

// Where a narrow camera has next to none of a segment's features in its picture, say.
TEST_F(ConfidenceTest, FoundOtherwiseItGoesOnByOdometryForAShortWay) {
  confidence_.SetFound();
  EXPECT_EQ(See(2, 124).trust, Trust::kBlind);
  EXPECT_EQ(See(2, 2).trust, Trust::kLost);
}

TEST_F(ConfidenceTest, GoesOnByAFewFeaturesForAShortWay) {
  See(9);
  EXPECT_EQ(See(5, 24).trust, Trust::kUnsure);
  EXPECT_EQ(See(5, 100).trust, Trust::kBlind) << "as many agree in any picture";
  EXPECT_EQ(See(5, 2).trust, Trust::kLost);
}

TEST_F(ConfidenceTest, BeingSureAgainStartsTheWayAnew) {
  See(9);
  See(5, 100);
  EXPECT_EQ(See(9).trust, Trust::kSure);
  EXPECT_EQ(See(5, 20).trust, Trust::kUnsure);
}

TEST_F(ConfidenceTest, AViewThatFadesIsFollowedByBlindDriving) {
  See(9);  // enough to be sure, but not a good view
  EXPECT_EQ(See(0, 60).trust, Trust::kBlind);
}

TEST_F(ConfidenceTest, AViewThatLeavesOverTheEdgeWasNotCovered) {
  See(30);
  Vanish(14);
  EXPECT_EQ(See(0, 40).trust, Trust::kBlind);
}

TEST_F(ConfidenceTest, AGoodViewGoneAllAtOnceWasCovered) {
  See(30);
  Vanish(30);
  EXPECT_EQ(See(0, 540).trust, Trust::kCovered);
  EXPECT_EQ(See(30).trust, Trust::kSure);
}

TEST_F(ConfidenceTest, AGoodViewIsGoingForAMomentAfterIt) {
  See(30);
  EXPECT_FALSE(confidence_.view_is_going());
  Vanish(16);
  See(9, 20);
  EXPECT_TRUE(confidence_.view_is_going());
  See(9);
  EXPECT_FALSE(confidence_.view_is_going());
}

TEST_F(ConfidenceTest, ANarrowCameraNeedNotSeeWhatIsOutsideItsPicture) {
  EXPECT_EQ(See(6).trust, Trust::kSeeking);
  in_picture_ = 12;
  EXPECT_EQ(See(6).trust, Trust::kSure);
  EXPECT_EQ(See(4).trust, Trust::kUnsure);
}

TEST_F(ConfidenceTest, AViewThatShouldBeNearlyEmptyIsNotCovered) {
  See(30);
  Vanish(28);
  in_picture_ = 5;
  EXPECT_EQ(See(1).trust, Trust::kBlind);
}

TEST_F(ConfidenceTest, WhoeverCoveredTheViewIsStillAboutAtTheNextHandOver) {
  See(30);
  Vanish(28);
  EXPECT_EQ(See(1).trust, Trust::kCovered);
  EXPECT_EQ(See(12, 30).trust, Trust::kSure) << "beside the one who stands there";
  NextSegment(20);
  EXPECT_EQ(See(0).trust, Trust::kCovered);
  EXPECT_EQ(See(15, 200).trust, Trust::kSure) << "gone now";
  NextSegment(20);
  EXPECT_EQ(See(0).trust, Trust::kBlind);
}

TEST_F(ConfidenceTest, AViewThatIsRecognisedUntilAllOfItIsGoneWasCovered) {
  See(30);
  Vanish(28);
  recognised_ = true;
  EXPECT_EQ(See(2).trust, Trust::kBlind) << "steered by the view as a whole";
  EXPECT_EQ(See(1).trust, Trust::kCovered);
}

TEST_F(ConfidenceTest, WhoeverCoversAViewThatIsRecognisedForAMomentIsStillThere) {
  See(30);
  Vanish(28);
  EXPECT_EQ(See(1, 60).trust, Trust::kCovered);
  recognised_ = true;
  EXPECT_EQ(See(2).trust, Trust::kBlind);
  EXPECT_EQ(See(1, 60).trust, Trust::kCovered);
}

TEST_F(ConfidenceTest, AViewOfWhichSomeIsStillThereWasNotCovered) {
  See(30);
  Vanish(28);
  glimpsed_ = true;
  EXPECT_EQ(See(2).trust, Trust::kBlind) << "smeared, say";
  EXPECT_EQ(See(2).trust, Trust::kCovered);
  glimpsed_ = true;
  EXPECT_EQ(See(2).trust, Trust::kBlind);
}

TEST_F(ConfidenceTest, IsLostWhenTheViewStaysCovered) {
  See(30);
  Vanish(30);
  See(0, 540);
  const Verdict verdict = See(0);
  EXPECT_EQ(verdict.trust, Trust::kLost);
  EXPECT_EQ(verdict.reason.find("something covers the view, or the camera was knocked aside: "), 0U)
      << verdict.reason;
}

TEST_F(ConfidenceTest, ASegmentThatIsNotFoundAtItsStartWasNotCovered) {
  See(30);
  NextSegment(kTaught);
  EXPECT_EQ(See(0, 10).trust, Trust::kBlind);
}

TEST_F(ConfidenceTest, AViewThatIsGoingWhenASegmentEndsAndGoneAfterItWasCovered) {
  See(30);
  Vanish(14);
  EXPECT_EQ(See(5).trust, Trust::kUnsure);
  NextSegment(kTaught);
  Vanish(10);
  EXPECT_EQ(See(0).trust, Trust::kCovered);
}

TEST_F(ConfidenceTest, DistantFeaturesAloneDoNotTellThePlace) {
  left_sigma_m_ = 0.1;
  EXPECT_EQ(See(30, 49).trust, Trust::kSure) << "the start's own uncertainty";
  const Verdict verdict = See(30, 400);
  EXPECT_EQ(verdict.trust, Trust::kDistant);
  EXPECT_EQ(verdict.reason,
            "only distant features are in view: the place beside the path is known to 0.10 m at "
            "best");
  left_sigma_m_ = 0.03;
  EXPECT_EQ(See(30).trust, Trust::kSure);
}

TEST_F(ConfidenceTest, IsLostWhenThePathMayBeAnywhere) {
  See(30, 100);
  left_sigma_m_ = 0.6;
  EXPECT_EQ(See(30).trust, Trust::kLost);
}

TEST_F(ConfidenceTest, CarriedOffItMayTakeAWhileToKnowWhereTo) {
  See(30, 100);
  left_sigma_m_ = 0.6;
  carried_off_ = true;
  const Verdict verdict = See(30, 140);
  EXPECT_EQ(verdict.trust, Trust::kDistant);
  EXPECT_EQ(verdict.reason, "carried off the path: where to is known to 0.60 m so far");
  EXPECT_EQ(See(30, 20).trust, Trust::kLost);
}

TEST_F(ConfidenceTest, CarriedToAndFroAllTheTimeItIsLost) {
  See(30, 100);
  for (int i = 0; i < 8; ++i) {
    carried_off_ = true;
    EXPECT_EQ(See(30, 10).trust, Trust::kSure);
  }
  carried_off_ = true;
  const Verdict verdict = See(30);
  EXPECT_EQ(verdict.trust, Trust::kLost);
  EXPECT_EQ(verdict.reason,
            "carried off 9 times by what it sees: the features in view contradict each other");
}

TEST_F(ConfidenceTest, CarriedOffNowAndThenItGoesOn) {
  See(30, 100);
  for (int i = 0; i < 20; ++i) {
    carried_off_ = true;
    EXPECT_EQ(See(30, 160).trust, Trust::kSure);  // 3.2 m
  }
}

TEST_F(ConfidenceTest, ASegmentTaughtWithoutFeaturesIsDrivenByOdometry) {
  See(30);
  NextSegment(2);
  const Verdict verdict = See(0, 500);
  EXPECT_EQ(verdict.trust, Trust::kBlind);
  EXPECT_EQ(verdict.reason, "this section was taught without features: on by odometry");
}

TEST_F(ConfidenceTest, WithoutOdometryAStretchTaughtWithoutFeaturesLeavesItBlind) {
  See(9, 1, std::nullopt);
  NextSegment(1);
  EXPECT_EQ(See(0, 1, std::nullopt).trust, Trust::kBlind) << "nothing carries it on";
  EXPECT_EQ(See(0, 90, std::nullopt).trust, Trust::kLost);
}

TEST_F(ConfidenceTest, ARouteThatBeginsWithoutFeaturesIsSought) {
  NextSegment(2);
  EXPECT_EQ(See(2).trust, Trust::kSeeking);
}

TEST_F(ConfidenceTest, WithoutOdometryFramesCountInsteadOfMetres) {
  See(9, 1, std::nullopt);
  EXPECT_EQ(See(0, 90, std::nullopt).trust, Trust::kBlind);
  EXPECT_EQ(See(0, 1, std::nullopt).trust, Trust::kLost);
}

}  // namespace
}  // namespace trailcast::agent
