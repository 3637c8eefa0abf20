#include "services/teach/heading_fit.h"

#include <gtest/gtest.h>

#include <vector>

#include "services/route/heading.h"

namespace trailcast::teach {
namespace {

TEST(HeadingFit, ACubicIsRecoveredExactly) {
  std::vector<HeadingSample> samples;
  for (double s = 0.0; s <= 2.0; s += 0.1) {
    samples.push_back({s, 0.3 * s - 0.2 * s * s + 0.05 * s * s * s});
  }
  const auto fit = FitHeading(samples);
  EXPECT_NEAR(fit.c[0], 0.3, 1e-9);
  EXPECT_NEAR(fit.c[1], -0.2, 1e-9);
  EXPECT_NEAR(fit.c[2], 0.05, 1e-9);
}

TEST(HeadingFit, AStraightSegmentHasNoHeading) {
  const std::vector<HeadingSample> samples{{0.0, 0.0}, {0.5, 0.0}, {1.0, 0.0}, {1.5, 0.0}};
  EXPECT_NEAR(route::HeadingAt(FitHeading(samples), 1.0), 0.0, 1e-12);
}

TEST(HeadingFit, TurnThenStraightIsFollowedWithinThreeDegrees) {
  std::vector<HeadingSample> samples;
  for (double s = 0.0; s <= 2.0; s += 0.05) samples.push_back({s, s < 1.0 ? 0.5 * s : 0.5});
  const auto fit = FitHeading(samples);
  for (const HeadingSample& sample : samples) {
    EXPECT_NEAR(route::HeadingAt(fit, sample.distance_m), sample.heading_rad, 0.052);
  }
}

TEST(HeadingFit, TwoSamplesGiveAPolynomialThroughBoth) {
  const std::vector<HeadingSample> samples{{0.0, 0.0}, {0.4, 0.2}};
  EXPECT_NEAR(route::HeadingAt(FitHeading(samples), 0.4), 0.2, 1e-9);
}

TEST(HeadingFit, StandingStillGivesNone) {
  EXPECT_EQ(FitHeading({}).c[0], 0.0);
  const std::vector<HeadingSample> spin{{0.0, 0.0}, {0.0, 0.5}};
  EXPECT_EQ(FitHeading(spin).c[0], 0.0);
}

}  // namespace
}  // namespace trailcast::teach
