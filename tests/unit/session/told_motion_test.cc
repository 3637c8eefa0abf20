#include "agent/session/src/told_motion.h"

#include <gtest/gtest.h>

namespace trailcast::agent {
namespace {

TEST(ToldMotion, ABaseComesUpToWhatItIsToldAndToAStand) {
  ToldMotion base;
  double driven_m = 0.0;
  for (int i = 0; i < 60; ++i) driven_m += base.Drive({0.5, 0.0}, 1.0 / 30.0).distance_m;
  EXPECT_NEAR(driven_m, 1.0 - 0.5 * 0.15, 0.02) << "later by its lag";
  for (int i = 0; i < 60; ++i) driven_m += base.Drive({}, 1.0 / 30.0).distance_m;
  EXPECT_NEAR(driven_m, 1.0, 0.02);
  EXPECT_NEAR(base.Drive({}, 1.0 / 30.0).distance_m, 0.0, 1e-5);
}

TEST(ToldMotion, IsTheSameHoweverManyPicturesThereAre) {
  ToldMotion often;
  ToldMotion seldom;
  double often_m = 0.0;
  double seldom_m = 0.0;
  for (int i = 0; i < 120; ++i) often_m += often.Drive({0.5, 0.3}, 1.0 / 60.0).distance_m;
  for (int i = 0; i < 20; ++i) seldom_m += seldom.Drive({0.5, 0.3}, 0.1).distance_m;
  EXPECT_NEAR(often_m, seldom_m, 0.03);
}

TEST(ToldMotion, NobodyDoubtsThatItStands) {
  EXPECT_EQ(DoubtOfTold({}).distance_m, 0.0);
  EXPECT_EQ(DoubtOfTold({}).heading_change_rad, 0.0);
  EXPECT_GT(DoubtOfTold({0.1, 0.0}).heading_change_rad, 0.0);
}

}  // namespace
}  // namespace trailcast::agent
