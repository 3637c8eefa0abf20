#include "services/teach/picture_turn.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace trailcast::teach {
namespace {

constexpr double kNoise_px = 0.12;
constexpr int kWidth_px = 320;

// Features all over the picture that move as one, and so many that move as they like.
std::vector<MovedFeature> Moved(double u_px, double v_px, double growth, int wild = 0) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> across(-150.0, 150.0);
  std::normal_distribution<double> noise(0.0, kNoise_px);
  std::vector<MovedFeature> features;
  for (int i = 0; i < 40; ++i) {
    const route::TrackedFeature before{i, across(random), 0.7 * across(random)};
    route::TrackedFeature now = before;
    now.u_px += i < wild ? 0.2 * across(random) : u_px + growth * before.u_px + noise(random);
    now.v_px += i < wild ? 0.2 * across(random) : v_px + growth * before.v_px + noise(random);
    features.push_back({before, now});
  }
  return features;
}

TEST(PictureTurn, TellsATurnFromDrivingOn) {
  const PictureFlow flow = FlowOf(Moved(12.0, -1.0, 0.03), kNoise_px);
  EXPECT_NEAR(flow.u_px, 12.0, 0.1);
  EXPECT_NEAR(flow.v_px, -1.0, 0.1);
  EXPECT_NEAR(flow.growth, 0.03, 0.001);
}

TEST(PictureTurn, AThirdOfTheFeaturesMayMoveAsTheyLike) {
  const PictureFlow flow = FlowOf(Moved(12.0, 0.0, 0.03, 13), kNoise_px);
  EXPECT_NEAR(flow.u_px, 12.0, 0.2);
  EXPECT_NEAR(flow.growth, 0.03, 0.003);
}

TEST(PictureTurn, WhatMovesToTheRightTurnsTheRobotToTheLeft) {
  // A usual webcam has a focal length of 0.87 of its picture's width.
  EXPECT_NEAR(TurnOf({0.87 * kWidth_px * 0.1, 0.0, 0.0}, kWidth_px), 0.1, 1e-9);
}

TEST(PictureTurn, NoFeaturesTellNothing) {
  const PictureFlow none = FlowOf({}, kNoise_px);
  EXPECT_EQ(none.u_px, 0.0);
  const std::vector<MovedFeature> one{{{0, 10.0, 5.0}, {0, 13.0, 5.0}}};
  EXPECT_TRUE(std::isfinite(FlowOf(one, kNoise_px).u_px));
}

}  // namespace
}  // namespace trailcast::teach
