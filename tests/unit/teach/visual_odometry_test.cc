#include "services/teach/visual_odometry.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace trailcast::teach {
namespace {

constexpr int kOdometryWidth_px = 320;
constexpr double kOdometryFocal_px = route::kUsualFocalShare * kOdometryWidth_px;
constexpr double kOdometryFrame_s = 1.0 / 30.0;

struct CorridorMark {
  double x_m = 0.0;  // ahead of the first picture
  double y_m = 0.0;  // left
  double z_m = 0.0;  // up
};

// A corridor of landmarks on both walls, which a pinhole camera drives along.
class Corridor {
 public:
  explicit Corridor(double noise_px) : noise_px_(noise_px), random_(7) {
    std::uniform_real_distribution<double> along(1.0, 40.0);
    std::uniform_real_distribution<double> height(-0.8, 0.8);
    for (int i = 0; i < 1200; ++i) {
      landmarks_.push_back({along(random_), i % 2 == 0 ? 1.0 : -1.2, height(random_)});
    }
  }

  [[nodiscard]] VisualOdometry::Features See(double x_m, double heading_rad) {
    std::normal_distribution<double> noise(0.0, noise_px_);
    VisualOdometry::Features seen;
    for (std::size_t i = 0; i < landmarks_.size(); ++i) {
      const double dx = landmarks_[i].x_m - x_m;
      const double dy = landmarks_[i].y_m;
      const double ahead = dx * std::cos(heading_rad) + dy * std::sin(heading_rad);
      const double left = dy * std::cos(heading_rad) - dx * std::sin(heading_rad);
      if (ahead < 0.5) continue;
      const double u = -kOdometryFocal_px * left / ahead + noise(random_);
      const double v = -kOdometryFocal_px * landmarks_[i].z_m / ahead + noise(random_);
      if (std::abs(u) > 160.0 || std::abs(v) > 120.0 || ahead > 8.0) continue;
      const int id = static_cast<int>(i);
      seen[id] = {id, u, v};
    }
    return seen;
  }

 private:
  double noise_px_;
  std::mt19937 random_;
  std::vector<CorridorMark> landmarks_;
};

// This is what a segment was, in truth and as it is told.
struct ToldWay {
  double true_m = 0.0;
  double told_m = 0.0;
  double true_rad = 0.0;
  double told_rad = 0.0;
  std::vector<double> true_at_m;
  std::vector<VisualOdometry::Place> places;
};

// Drives one segment after the other, as a scout whose speed and turn rate depend on the way.
class CorridorDrive {
 public:
  explicit CorridorDrive(double noise_px) : corridor_(noise_px), odometry_(kOdometryWidth_px) {}

  template <typename SpeedAt, typename TurnAt>
  ToldWay Segment(int frames, SpeedAt speed_at, TurnAt turn_at) {
    std::vector<VisualOdometry::Features> seen;
    std::vector<VisualOdometry::Moment> moments;
    ToldWay told;
    const double from_m = at_m_;
    const double from_rad = heading_rad_;
    for (int i = 0; i <= frames; ++i) {
      seen.push_back(corridor_.See(at_m_, heading_rad_));
      told.true_at_m.push_back(at_m_ - from_m);
      if (i == frames) break;
      heading_rad_ += kOdometryFrame_s * turn_at(at_m_);
      at_m_ += kOdometryFrame_s * speed_at(at_m_);
    }
    for (int i = 0; i <= frames; ++i) moments.push_back({kOdometryFrame_s * i, &seen[i], 0.0});
    told.places = odometry_.Follow(moments);
    told.true_m = at_m_ - from_m;
    told.true_rad = heading_rad_ - from_rad;
    told.told_m = told.places.back().way_m;
    told.told_rad = told.places.back().turned_rad;
    return told;
  }

 private:
  Corridor corridor_;
  VisualOdometry odometry_;
  double at_m_ = 0.0;
  double heading_rad_ = 0.0;
};

double NoTurn(double) { return 0.0; }

TEST(VisualOdometry, TellsWhereInsideASegmentTheScoutSlowedDown) {
  CorridorDrive drive(0.1);
  const auto speed = [](double at_m) { return at_m < 0.4 ? 0.4 : 0.2; };
  const ToldWay told = drive.Segment(90, speed, NoTurn);
  const double factor = told.told_m / told.true_m;
  for (std::size_t i = 0; i < told.places.size(); ++i) {
    EXPECT_NEAR(told.places[i].way_m / factor, told.true_at_m[i], 0.03) << i;
  }
}

TEST(VisualOdometry, KeepsItsFactorFromSegmentToSegment) {
  CorridorDrive drive(0.1);
  const auto speed = [](double at_m) { return at_m < 3.0 ? 0.4 : 0.2; };
  const ToldWay first = drive.Segment(60, speed, NoTurn);
  double last_factor = 0.0;
  for (int i = 0; i < 12; ++i) {
    const ToldWay told = drive.Segment(60, speed, NoTurn);
    last_factor = told.told_m / told.true_m;
  }
  EXPECT_NEAR(std::log(last_factor / (first.told_m / first.true_m)), 0.0, 0.15);
}

TEST(VisualOdometry, TellsTurns) {
  CorridorDrive drive(0.1);
  const ToldWay told = drive.Segment(
      60, [](double) { return 0.3; }, [](double) { return 0.1; });
  EXPECT_NEAR(told.told_rad, told.true_rad, 0.02);
}

TEST(VisualOdometry, IsNotLedAstrayByAQuarterOfWrongTracks) {
  CorridorDrive drive(0.1);
  const ToldWay right = drive.Segment(
      60, [](double) { return 0.3; }, NoTurn);
  Corridor corridor(0.1);
  std::mt19937 random(3);
  std::normal_distribution<double> wrong_px(0.0, 8.0);
  std::vector<VisualOdometry::Features> seen;
  for (int i = 0; i <= 60; ++i) {
    seen.push_back(corridor.See(0.3 * kOdometryFrame_s * i, 0.0));
    for (auto& [id, feature] : seen.back()) {
      if (id % 4 == 0) feature.u_px += wrong_px(random);
    }
  }
  std::vector<VisualOdometry::Moment> moments;
  for (int i = 0; i <= 60; ++i) moments.push_back({kOdometryFrame_s * i, &seen[i], 0.0});
  VisualOdometry odometry(kOdometryWidth_px);
  EXPECT_NEAR(odometry.Follow(moments).back().way_m, right.told_m, 0.15 * right.told_m);
}

TEST(VisualOdometry, WithoutFeaturesTheScoutDrivesOnAsBefore) {
  const VisualOdometry::Features nothing;
  std::vector<VisualOdometry::Moment> moments;
  for (int i = 0; i <= 30; ++i) moments.push_back({kOdometryFrame_s * i, &nothing, 0.01 * i});
  VisualOdometry odometry(kOdometryWidth_px);
  const auto places = odometry.Follow(moments);
  ASSERT_EQ(places.size(), moments.size());
  for (std::size_t i = 1; i < places.size(); ++i) EXPECT_GT(places[i].way_m, places[i - 1].way_m);
  EXPECT_NEAR(places.back().way_m, route::kUsualSpeed_mps, 0.05);
}

TEST(VisualOdometry, TheWayRisesWhateverThePicturesShow) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> anywhere(-160.0, 160.0);
  VisualOdometry odometry(kOdometryWidth_px);
  for (int segment = 0; segment < 20; ++segment) {
    std::vector<VisualOdometry::Features> seen(10);
    for (auto& features : seen) {
      for (int id = 0; id < 12; ++id) features[id] = {id, anywhere(random), anywhere(random)};
    }
    std::vector<VisualOdometry::Moment> moments;
    for (std::size_t i = 0; i < seen.size(); ++i) {
      moments.push_back({kOdometryFrame_s * static_cast<double>(i), &seen[i], 0.0});
    }
    const auto places = odometry.Follow(moments);
    for (std::size_t i = 1; i < places.size(); ++i) {
      ASSERT_TRUE(std::isfinite(places[i].way_m));
      EXPECT_GT(places[i].way_m, places[i - 1].way_m) << segment << ' ' << i;
    }
  }
}

TEST(VisualOdometry, OneMomentOrNoTimeIsNoWay) {
  const VisualOdometry::Features nothing;
  VisualOdometry odometry(kOdometryWidth_px);
  EXPECT_TRUE(odometry.Follow({}).empty());
  const std::vector<VisualOdometry::Moment> one{{0.0, &nothing, 0.0}};
  EXPECT_EQ(odometry.Follow(one).back().way_m, 0.0);
}

}  // namespace
}  // namespace trailcast::teach
