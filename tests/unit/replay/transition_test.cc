#include "services/replay/transition.h"

#include <gtest/gtest.h>

#include <cmath>

namespace trailcast::replay {
namespace {

TEST(EndProbability, IsOneWithoutErrors) {
  EXPECT_DOUBLE_EQ(EndProbability({0.0, 20.0, 0.0, 2.0, 0.0, 0.1}), 1.0);
}

TEST(EndProbability, IsTheProductOfThreeHandWorkedGaussians) {
  // e_f = 200, sigma_f = 20: exp(-0.25); e_l = 1, sigma_l = 2: exp(-0.125); e_h = 0.01, sigma_h =
  // 0.1: exp(-0.5).
  EXPECT_NEAR(EndProbability({200.0, 20.0, 1.0, 2.0, 0.01, 0.1}), std::exp(-0.875), 1e-12);
}

TEST(EndProbability, LeavesOutWhatHasNoScale) {
  EXPECT_NEAR(EndProbability({200.0, 20.0, 5.0, 0.0, 3.0, 0.0}), std::exp(-0.25), 1e-12);
}

TEST(MedianFilter, LetsNoSingleSpikeThrough) {
  MedianFilter filter(5);
  for (int i = 0; i < 5; ++i) EXPECT_EQ(filter.Add(1.0), 1.0);
  EXPECT_EQ(filter.Add(100.0), 1.0);
  EXPECT_EQ(filter.Add(1.0), 1.0);
}

TEST(MedianFilter, FollowsAStepAfterHalfItsLength) {
  MedianFilter filter(5);
  for (int i = 0; i < 5; ++i) EXPECT_EQ(filter.Add(0.0), 0.0);
  EXPECT_EQ(filter.Add(1.0), 0.0);
  EXPECT_EQ(filter.Add(1.0), 0.0);
  EXPECT_EQ(filter.Add(1.0), 1.0);
}

// Drives past a milestone at 1 m in steps of 2 cm; returns where the detector fired.
double DistanceOfTransition(double tau) {
  TransitionDetector detector({tau, 5});
  for (double s = 0.0; s < 3.0; s += 0.02) {
    const double delta = std::exp(-(s - 1.0) * (s - 1.0) / 0.5);
    const double delta_minus = std::exp(-s * s / 2.0);
    if (detector.Add(delta, delta_minus)) return s;
  }
  return 99.0;
}

TEST(TransitionDetector, FiresSoonAfterThePeak) {
  // exp(-x^2/0.5) has fallen by 0.05 at x = 0.16 m; the median adds two steps.
  EXPECT_NEAR(DistanceOfTransition(0.05), 1.16 + 0.04, 0.03);
}

TEST(TransitionDetector, LargerTauFiresLater) {
  EXPECT_GT(DistanceOfTransition(0.2), DistanceOfTransition(0.05));
}

TEST(TransitionDetector, KnowsWhereThePeakWas) {
  TransitionDetector detector;
  double peak_s = 0.0;
  for (double s = 0.0;
       !detector.Add(std::exp(-(s - 1.0) * (s - 1.0) / 0.5), std::exp(-s * s / 2.0)); s += 0.02) {
    if (detector.at_peak()) peak_s = s;
  }
  EXPECT_NEAR(peak_s, 1.0, 0.07);  // the median is two steps late
}

TEST(TransitionDetector, DoesNotFireWhileThePreviousMilestoneIsAsLikelyAsEver) {
  TransitionDetector detector;
  for (int i = 0; i < 50; ++i) EXPECT_FALSE(detector.Add(i < 10 ? 0.9 : 0.5, 0.8));
}

}  // namespace
}  // namespace trailcast::replay
