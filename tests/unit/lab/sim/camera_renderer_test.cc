#include "services/lab/sim/core/camera_renderer.h"

#include <gtest/gtest.h>

#include "tests/unit/lab/sim/test_worlds.h"

namespace trailcast::sim {
namespace {

using test::SmallWorld;

// At the origin, looking along x from a height of half a metre.
Eigen::Isometry3d AtOrigin() {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() = Eigen::Vector3d(0.0, 0.0, 0.5);
  pose.linear() = BodyFromCamera(0.0, 0.0);
  return pose;
}

CameraModel Pinhole() {
  CameraModel camera = *FindCamera("webcam");
  camera.distortion = 0.0;
  return camera;
}

Eigen::Vector2d Expected(const CameraModel& camera, const Eigen::Vector3d& point) {
  return *Lens(camera).Project(AtOrigin().inverse() * point);
}

float At(const PerfectView& view, int x, int y) {
  return view.gray[image::PixelIndex(x, y, view.width)];
}

class EveryLens : public ::testing::TestWithParam<std::string> {};

TEST_P(EveryLens, DrawsAWhiteBoxWhereItIs) {
  const CameraModel camera = *FindCamera(GetParam());
  const auto world = SmallWorld().WhiteBox({3.0F, 0.1F, 0.3F}, {3.2F, 0.5F, 0.7F}).Build();
  CameraRenderer renderer(world, camera);
  const PerfectView& view = renderer.Render(AtOrigin());
  const auto bright_at = [&](const Eigen::Vector3d& point) {
    const Eigen::Vector2d pixel = Expected(camera, point);
    return At(view, static_cast<int>(std::lround(pixel.x())),
              static_cast<int>(std::lround(pixel.y()))) > 235.0F;
  };
  EXPECT_TRUE(bright_at({3.0, 0.3, 0.5}));
  EXPECT_TRUE(bright_at({3.0, 0.14, 0.34}));
  EXPECT_TRUE(bright_at({3.0, 0.46, 0.66}));
  EXPECT_FALSE(bright_at({3.0, 0.03, 0.5}));
  EXPECT_FALSE(bright_at({3.0, 0.57, 0.5}));
  EXPECT_FALSE(bright_at({3.0, 0.3, 0.23}));
}

INSTANTIATE_TEST_SUITE_P(Set, EveryLens,
                         ::testing::Values("webcam", "firewire", "wide", "hd", "fisheye", "omni"),
                         [](const auto& parameter) { return parameter.param; });

TEST(CameraRenderer, KnowsTheDepthOfWhatItSees) {
  const auto world = SmallWorld().WhiteBox({3.0F, -1.0F, 0.0F}, {3.2F, 1.0F, 2.0F}).Build();
  CameraRenderer renderer(world, Pinhole());
  const PerfectView& view = renderer.Render(AtOrigin());
  EXPECT_NEAR(view.depth_m[120 * 320 + 160], 3.0F, 0.01F);
}

TEST(CameraRenderer, ARollingShutterHasSeenItsUpperRowsEarlier) {
  const auto world = SmallWorld().WhiteBox({3.0F, -2.0F, 0.0F}, {3.2F, 0.2F, 3.0F}).Build();
  const auto edge_at = [](const PerfectView& view, int y) {
    int x = 0;
    while (x < view.width && At(view, x, y) < 200.0F) ++x;
    return x;
  };
  CameraModel camera = Pinhole();
  CameraRenderer still(world, camera);
  camera.readout_s = 0.05;
  CameraRenderer rolling(world, camera);
  const CameraMotion turning{{0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}};
  const Eigen::Isometry3d now = AtOrigin();
  Eigen::Isometry3d before = now;
  before.rotate(Eigen::AngleAxisd(-0.05, Eigen::Vector3d::UnitY()));
  const PerfectView& rolled = rolling.Render(now, {}, turning);
  const int first = edge_at(rolled, 0);
  const int last = edge_at(rolled, rolled.height - 1);
  EXPECT_NEAR(first, edge_at(still.Render(before), 0), 1);
  EXPECT_NEAR(last, edge_at(still.Render(now), rolled.height - 1), 1);
  EXPECT_GT(std::abs(first - last), 10);
}

TEST(CameraRenderer, EdgesBetweenPixelsAreDrawnInBetween) {
  // A thin board whose left edge falls into the middle of pixel 200.
  const CameraModel camera = Pinhole();
  const Eigen::Vector3d ray = *Lens(camera).Direction({200.0, 119.5});
  const auto edge_y = static_cast<float>(-3.0 * ray.x() / ray.z());
  const auto world = SmallWorld().WhiteBox({3.0F, -1.0F, 0.0F}, {3.005F, edge_y, 2.0F}).Build();
  CameraRenderer renderer(world, camera);
  const PerfectView& view = renderer.Render(AtOrigin());
  const float outside = At(view, 197, 150);
  const float inside = At(view, 203, 150);
  EXPECT_GT(inside, outside + 20.0F);
  const float between = (At(view, 200, 150) - outside) / (inside - outside);
  EXPECT_GT(between, 0.2F);
  EXPECT_LT(between, 0.8F);
}

TEST(CameraRenderer, FineCheckersFarAwayAreAveragedNotAliased) {
  image::Canvas checkers(256, 256, {0, 0, 0});
  for (int y = 0; y < 32; ++y) {
    for (int x = y % 2; x < 32; x += 2) {
      checkers.FillPolygon({{8.0 * x, 8.0 * y},
                            {8.0 * x + 7, 8.0 * y},
                            {8.0 * x + 7, 8.0 * y + 7},
                            {8.0 * x, 8.0 * y + 7}},
                           {250, 250, 250});
    }
  }
  // Fields of 3 mm at 8 m: a tenth of a pixel each.
  const auto world = SmallWorld().Picture(checkers.picture(), 8.0F, 0.1F, 0.6F).Build();
  const auto near_world = SmallWorld().Picture(checkers.picture(), 0.3F, 1.2F, 1.2F).Build();
  CameraRenderer renderer(world, Pinhole());
  const PerfectView& view = renderer.Render(AtOrigin());
  EXPECT_NEAR(At(view, 160, 121), 115.0F, 25.0F);
  EXPECT_NEAR(At(view, 159, 121), At(view, 160, 121), 12.0F);
  CameraRenderer near_renderer(near_world, Pinhole());
  const PerfectView& near_view = near_renderer.Render(AtOrigin());
  constexpr std::ptrdiff_t kRow = 38'400;  // the 120th, of 320 pixels
  const auto [darkest, brightest] =
      std::minmax_element(near_view.gray.begin() + kRow, near_view.gray.begin() + kRow + 320);
  EXPECT_LT(*darkest, 20.0F);
  EXPECT_GT(*brightest, 220.0F);
}

TEST(CameraRenderer, SunCastsTheShadowOfABoxToItsOtherSide) {
  const auto world =
      SmallWorld().WhiteBox({3.0F, -0.2F, 0.0F}, {3.4F, 0.2F, 0.6F}).Sun({0, 1, 1}).Build();
  CameraRenderer renderer(world, Pinhole());
  const PerfectView& view = renderer.Render(AtOrigin());
  const Eigen::Vector2d shadow = Expected(Pinhole(), {3.2, -0.5, 0.0});
  const Eigen::Vector2d sunny = Expected(Pinhole(), {3.2, 0.5, 0.0});
  const float dark = At(view, static_cast<int>(shadow.x()), static_cast<int>(shadow.y()));
  const float bright = At(view, static_cast<int>(sunny.x()), static_cast<int>(sunny.y()));
  EXPECT_LT(dark, 0.75F * bright);
}

TEST(CameraRenderer, SkyIsSeenWhereNothingIs) {
  const auto world = SmallWorld().Build();
  CameraRenderer renderer(world, Pinhole());
  const PerfectView& view = renderer.Render(AtOrigin());
  EXPECT_GT(At(view, 160, 5), 140.0F);
  EXPECT_GT(view.depth_m[5 * 320 + 160], 1e6F);
  EXPECT_NEAR(At(view, 160, 230), 100.0F, 2.0F);
}

TEST(CameraRenderer, SameViewTwiceIsTheSameBitForBit) {
  const auto world = SmallWorld().WhiteBox({3, 0, 0}, {4, 1, 1}).Sun({1, 1, 1}).Build();
  CameraRenderer first(world, *FindCamera("wide"));
  CameraRenderer second(world, *FindCamera("wide"));
  Eigen::Isometry3d elsewhere = AtOrigin();
  elsewhere.translation().x() = 1.0;
  EXPECT_NE(first.Render(elsewhere).gray, second.Render(AtOrigin()).gray);
  EXPECT_EQ(first.Render(AtOrigin()).gray, second.Render(AtOrigin()).gray);
}

}  // namespace
}  // namespace trailcast::sim
