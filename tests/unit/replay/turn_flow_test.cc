#include "services/replay/turn_flow.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace trailcast::replay {
namespace {

constexpr int kWidth_px = 320;

// This is what a camera with such a lens has of a scene all round while it turns on the spot.
class TurningEye {
 public:
  using Lens = double (*)(double focal_px, double from_axis_rad);
  TurningEye(double focal_px, Lens lens) : focal_px_(focal_px), lens_(lens) {}

  std::optional<FocalLength> Turn(const std::vector<double>& to_rad, double carried_share = 0.0) {
    TurnFlow flow(kWidth_px);
    double heading_rad = 0.0;
    flow.Look(See(heading_rad, carried_share), 0.0);
    for (const double aim_rad : to_rad) {
      const double step_rad = std::copysign(0.02, aim_rad - heading_rad);
      while (std::abs(aim_rad - heading_rad) > 0.01) {
        heading_rad += step_rad;
        flow.Look(See(heading_rad, carried_share), step_rad);
      }
    }
    return flow.focal();
  }

 private:
  // Returns the features, a share of which slides along with the picture, as on a dirty lens.
  std::vector<route::TrackedFeature> See(double heading_rad, double carried_share) {
    std::vector<route::TrackedFeature> seen;
    constexpr int kFeatures = 60;
    for (int id = 0; id < kFeatures; ++id) {
      const bool carried = id < carried_share * kFeatures;
      const double bearing_rad = -0.9 + 1.8 * id / kFeatures;
      const double u_px = lens_(focal_px_, (carried ? 0.0 : heading_rad) + bearing_rad);
      if (std::abs(u_px) > 0.5 * kWidth_px) continue;
      seen.push_back({id, u_px + noise_(random_), 0.3 * u_px});
    }
    return seen;
  }

  double focal_px_;
  Lens lens_;
  std::mt19937 random_{7};
  std::normal_distribution<double> noise_{0.0, 0.5};
};

double Pinhole(double focal_px, double from_axis_rad) { return focal_px * std::tan(from_axis_rad); }
double Fisheye(double focal_px, double from_axis_rad) { return focal_px * from_axis_rad; }

TEST(TurnFlow, TellsTheFocalLengthOfAnyLens) {
  for (const double focal_px : {150.0, 277.0, 480.0}) {
    const auto told = TurningEye(focal_px, Pinhole).Turn({0.2, -0.2, 0.0});
    ASSERT_TRUE(told) << focal_px;
    EXPECT_NEAR(told->px, focal_px, 0.04 * focal_px);
    EXPECT_LT(told->sigma, 0.1);
  }
  const auto told = TurningEye(140.0, Fisheye).Turn({0.2, -0.2, 0.0});
  ASSERT_TRUE(told);
  EXPECT_NEAR(told->px, 140.0, 0.06 * 140.0);
}

TEST(TurnFlow, IsNotLedByWhatDoesNotTurn) {
  const auto told = TurningEye(277.0, Pinhole).Turn({0.2, -0.2, 0.0}, 0.3);
  ASSERT_TRUE(told);
  EXPECT_NEAR(told->px, 277.0, 0.06 * 277.0);
}

TEST(TurnFlow, SaysNothingBeforeItHasTurned) {
  EXPECT_FALSE(TurningEye(277.0, Pinhole).Turn({0.05, -0.04}));
  EXPECT_FALSE(TurnFlow(kWidth_px).focal());
}

}  // namespace
}  // namespace trailcast::replay
