#include "services/lab/trial/recording/judge.h"

#include <gmock/gmock.h>

#include <cmath>

namespace trailcast::trial {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr int kTeachFrames = 100;

// A replay as a small language: frame by frame along a route of 100 frames, 10 frames a second.
class Drive {
 public:
  Drive() { replayed_.teach_frames = kTeachFrames; }

  // So many frames that follow so far from the truth.
  Drive& Follow(int frames, double off = 0.0, double turn_rad = 0.0) {
    return Say(frames, Claim::kFollowing, off, turn_rad);
  }
  Drive& Say(int frames, Claim claim, double off = 0.0, double turn_rad = 0.0) {
    for (int i = 0; i < frames; ++i) {
      Show();
      replayed_.said.push_back({claim, next_ - 1 + off, turn_rad});
    }
    return *this;
  }
  // Shown, but the run had ended.
  Drive& Unseen(int frames) {
    for (int i = 0; i < frames; ++i) Show();
    return *this;
  }
  Drive& Cut(int to_frame) {
    next_ = to_frame;
    cut_ = true;
    return *this;
  }
  Drive& Stride(int stride) {
    replayed_.stride = stride;
    return *this;
  }

  Drive& OwnTurns(const std::vector<std::optional<double>>& turns_rad) {
    replayed_.own_turns_rad = turns_rad;
    return *this;
  }

  [[nodiscard]] const Replayed& replayed() const { return replayed_; }
  [[nodiscard]] Verdict Judged(const Reference& reference, const Steering& steering = {}) const {
    JudgeOptions options;
    options.rate_hz = 10.0;
    options.width_px = 160;
    return Judge(replayed_, reference, steering, options);
  }
  [[nodiscard]] Verdict Judged() const { return Judged(IdentityReference(kTeachFrames)); }

 private:
  void Show() {
    replayed_.shown.push_back({next_, cut_});
    next_ += replayed_.stride;
    cut_ = false;
  }

  Replayed replayed_;
  int next_ = 0;
  bool cut_ = false;
};

TEST(Judge, CountsWhatWasSaidOverAllFrames) {
  const Verdict verdict = Drive()
                              .Follow(10)
                              .Say(5, Claim::kUnsure)
                              .Say(3, Claim::kLost)
                              .Say(2, Claim::kArrived)
                              .Unseen(4)
                              .Judged();
  EXPECT_EQ(verdict.frames, 24);
  EXPECT_EQ(verdict.following, 12);
  EXPECT_EQ(verdict.lost, 3);
  EXPECT_TRUE(verdict.arrived);
  EXPECT_FALSE(Drive().Follow(3).Judged().arrived);
}

TEST(Judge, RightIsWithinFivePercentOfTheTaughtRecording) {
  EXPECT_EQ(Drive().Follow(20, 5.0).Judged().right, 20);
  EXPECT_EQ(Drive().Follow(20, -5.0).Judged().right, 20);
  const Verdict off = Drive().Follow(20, 5.1).Judged();
  EXPECT_EQ(off.right, 0);
  EXPECT_EQ(off.wrong, 20);
  EXPECT_EQ(off.aligned, 20);
}

TEST(Judge, WhoDoesNotFollowIsNeitherRightNorWrong) {
  const Verdict verdict = Drive().Say(20, Claim::kUnsure).Say(20, Claim::kLost, 50.0).Judged();
  EXPECT_EQ(verdict.right, 0);
  EXPECT_EQ(verdict.wrong, 0);
  EXPECT_EQ(verdict.aligned, 40);
}

TEST(Judge, FramesThatTheRunDidNotReachAreNotRight) {
  const Verdict verdict = Drive().Follow(10).Unseen(30).Judged();
  EXPECT_EQ(verdict.right, 10);
  EXPECT_EQ(verdict.aligned, 40);
}

TEST(Judge, OnlyGoodAlignmentsCount) {
  const Reference reference{{0, 0, 30, 0.0, true}, {2, 50, 5, 0.0, false}, {4, 4, 30, 0.0, true}};
  const Verdict verdict = Drive().Follow(10).Judged(reference);
  EXPECT_EQ(verdict.aligned, 2);
  EXPECT_EQ(verdict.right, 2);
}

TEST(Judge, AnAlignmentHoldsForTheNearestFrameShown) {
  const Reference reference{{4, 4, 30, 0.0, true}, {8, 8, 30, 0.0, true}, {10, 10, 30, 0.0, true}};
  const Drive run = Drive().Stride(3).Follow(5);  // frames 0, 3, 6, 9, 12
  const auto truth = AlignmentsOf(run.replayed(), reference);
  ASSERT_EQ(truth.size(), 5U);
  EXPECT_FALSE(truth[0] || truth[2] || truth[4]);
  EXPECT_EQ(truth[1]->replay_frame, 4);
  EXPECT_EQ(truth[3]->replay_frame, 8);  // as near as 10, and told once
}

TEST(Judge, SidesAreJudgedWhereTheTruthHasOneAndTheRobotFollows) {
  Reference reference;
  for (int i = 0; i < 30; ++i) reference.push_back({i, i, 30, i < 10 ? 1.9 : 3.0, true});
  const Verdict right = Drive().Follow(30, 0.0, 0.1).Judged(reference);
  EXPECT_EQ(right.sided, 20);  // 1.25 % of 160 pixels are 2
  EXPECT_EQ(right.side_right, 20);
  EXPECT_EQ(Drive().Follow(30, 0.0, -0.1).Judged(reference).side_right, 0);
  EXPECT_EQ(Drive().Follow(30, 0.0, 0.0).Judged(reference).side_right, 0);
  EXPECT_EQ(Drive().Say(30, Claim::kArrived, 0.0, 0.1).Judged(reference).sided, 0);
  for (Alignment& row : reference) row.median_du_px = -3.0;
  EXPECT_EQ(Drive().Follow(30, 0.0, -0.1).Judged(reference).side_right, 30);
}

TEST(Judge, SidesAreNotJudgedWithoutAWidth) {
  const Reference reference{{0, 0, 30, 50.0, true}};
  EXPECT_EQ(Judge(Drive().Follow(1, 0.0, 0.1).replayed(), reference, {}, {}).sided, 0);
}

TEST(Judge, CorrectionsAreJudgedBesideWhatTheRouteItselfAsksFor) {
  Reference reference;
  for (int i = 0; i < 30; ++i) reference.push_back({i, i, 30, 3.0, true});
  // The route bends to the left, and the robot is to be more to the right: less to the left.
  std::vector<std::optional<double>> own(20, -0.5);
  own[5] = std::nullopt;
  const Verdict less = Drive().OwnTurns(own).Follow(30, 0.0, -0.4).Judged(reference);
  EXPECT_EQ(less.sided, 30);
  EXPECT_EQ(less.side_right, 0);
  EXPECT_EQ(less.corrected, 19);
  EXPECT_EQ(less.correction_right, 19);
  EXPECT_EQ(Drive().OwnTurns(own).Follow(30, 0.0, -0.6).Judged(reference).correction_right, 0);
  EXPECT_EQ(Drive().Follow(30, 0.0, -0.4).Judged(reference).corrected, 0);
}

TEST(Judge, SteeringLeadsThePicture) {
  Steering steering;
  for (int frame = 0; frame < 40; ++frame) steering[frame] = frame == 10 ? 0.8 : 0.0;
  // The hand at frame 10 shows in the pictures 12 to 15.
  const Verdict early = Drive().Follow(12, 0.0, 0.1).Follow(28, 0.0, -0.1).Judged({}, steering);
  EXPECT_EQ(early.steered, 4);
  EXPECT_EQ(early.steered_alike, 0);
  const Verdict alike =
      Drive().Follow(12, 0.0, -0.1).Follow(4, 0.0, 0.1).Follow(24, 0.0, -0.1).Judged({}, steering);
  EXPECT_EQ(alike.steered_alike, 4);
}

TEST(Judge, SteeringIsJudgedWhileFollowing) {
  Steering steering;
  for (int frame = 0; frame < 40; ++frame) steering[frame] = -0.31;
  EXPECT_EQ(Drive().Say(40, Claim::kLost, 0.0, -0.1).Judged({}, steering).steered, 0);
  const Verdict verdict = Drive().Follow(40, 0.0, -0.1).Judged({}, steering);
  EXPECT_EQ(verdict.steered, verdict.steered_alike);
  EXPECT_GT(verdict.steered, 100);
}

TEST(Judge, TimesUntilFoundAgainAreCounted) {
  const Verdict verdict = Drive()
                              .Follow(10)
                              .Say(20, Claim::kUnsure)  // two seconds
                              .Follow(10)
                              .Follow(25, 40.0)
                              .Follow(10)
                              .Judged();
  EXPECT_EQ(verdict.offs, 2);
  EXPECT_EQ(verdict.found_in_time, 1);
  EXPECT_THAT(verdict.found_s, ElementsAre(2.0, 2.5));
}

TEST(Judge, WhoWasNeverRightIsNotSought) {
  EXPECT_EQ(Drive().Say(50, Claim::kUnsure).Follow(10).Judged().offs, 0);
}

TEST(Judge, TheEndLeavesOpenWhatItCutsShort) {
  const Verdict soon = Drive().Follow(10).Say(15, Claim::kUnsure).Judged();
  EXPECT_EQ(soon.offs, 0);
  const Verdict late = Drive().Follow(10).Say(30, Claim::kUnsure).Judged();
  EXPECT_EQ(late.offs, 1);
  EXPECT_EQ(late.found_in_time, 0);
  EXPECT_THAT(late.found_s, IsEmpty());
}

TEST(Judge, ACutIsAnOffEvenIfNothingIsNoticed) {
  const Verdict at_once = Drive().Follow(10).Cut(60).Follow(10).Judged();
  EXPECT_EQ(at_once.offs, 1);
  EXPECT_THAT(at_once.found_s, ElementsAre(0.0));
  const Verdict slow =
      Drive().Follow(10).Cut(60).Follow(5, -50.0).Say(10, Claim::kLost).Follow(5).Judged();
  EXPECT_EQ(slow.offs, 1);
  EXPECT_EQ(slow.found_in_time, 1);
  EXPECT_THAT(slow.found_s, ElementsAre(1.5));
}

TEST(Judge, ACutEndsTheSearchBeforeIt) {
  const Verdict verdict = Drive()
                              .Follow(10)
                              .Cut(60)
                              .Say(25, Claim::kLost)
                              .Cut(10)
                              .Say(5, Claim::kLost)
                              .Follow(5)
                              .Judged();
  EXPECT_EQ(verdict.offs, 2);
  EXPECT_EQ(verdict.found_in_time, 1);
}

TEST(Judge, VerdictsAddUp) {
  Verdict sum = Drive().Follow(10).Say(20, Claim::kUnsure).Follow(10).Judged();
  sum.Add(Drive().Say(5, Claim::kArrived).Judged());
  EXPECT_EQ(sum.frames, 45);
  EXPECT_EQ(sum.following, 25);
  EXPECT_EQ(sum.right, 25);
  EXPECT_EQ(sum.offs, 1);
  EXPECT_TRUE(sum.arrived);
  EXPECT_THAT(sum.found_s, ElementsAre(2.0));
}

}  // namespace
}  // namespace trailcast::trial
