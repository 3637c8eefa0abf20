#include "agent/device/src/still_picture_watch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <random>

#include "tests/support/painted_wall.h"

namespace trailcast::agent {
namespace {

using image::GrayImage;
using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr int kWidth_px = 160;
constexpr int kHeight_px = 120;
constexpr double kFrame_s = 0.1;
constexpr double kLimit_s = 3.0;

// A wall larger than the picture, painted once.
const GrayImage& Wall(unsigned seed) {
  static const GrayImage walls[] = {
      test::PaintedWall(1).Photograph({.width = 480, .height = 360}),
      test::PaintedWall(2).Photograph({.gain = 0.8, .width = 480, .height = 360})};
  return walls[seed];
}

double GreyAt(const GrayImage& picture, double x, double y) {
  x = std::clamp(x, 0.0, picture.width - 1.001);
  y = std::clamp(y, 0.0, picture.height - 1.001);
  const int column = static_cast<int>(x);
  const int row = static_cast<int>(y);
  const double right = x - column;
  const double down = y - row;
  return (1.0 - down) *
             ((1.0 - right) * picture.at(column, row) + right * picture.at(column + 1, row)) +
         down * ((1.0 - right) * picture.at(column, row + 1) +
                 right * picture.at(column + 1, row + 1));
}

// This is what the camera sees.
struct Sight {
  double scale = 1.0;
  double right_px = 0.0;
  double gain = 1.0;
  double noise_grey = 3.0;
  double painted_px = 1e3;  // from the picture's middle; the wall is blank beyond
  // A person who stands before it is this wide.
  double person_left_px = 0.0;
  double person_px = 0.0;
};

class StillPictureWatchTest : public testing::Test {
 protected:
  GrayImage Picture(const Sight& sight) {
    GrayImage picture{kWidth_px, kHeight_px, {}};
    std::normal_distribution<double> noise(0.0, sight.noise_grey);
    for (int y = 0; y < kHeight_px; ++y) {
      for (int x = 0; x < kWidth_px; ++x) {
        picture.pixels.push_back(static_cast<std::uint8_t>(
            std::clamp(std::lround(sight.gain * Level(sight, x, y) + noise(random_)), 0L, 255L)));
      }
    }
    return picture;
  }
  // Whether the drive is over at the end of so many seconds, ten frames a second.
  bool OverAfter(double for_s, const std::function<Sight(double)>& at) {
    bool over = false;
    for (double t_s = 0.0; t_s < for_s - 1e-6; t_s += kFrame_s) {
      over = watch_->Over(stamp_, Picture(at(t_s))) || over;
      stamp_ += FromSeconds(kFrame_s);
    }
    return over;
  }
  bool OverAfter(double for_s, const Sight& sight = {}) {
    return OverAfter(for_s, [&](double) { return sight; });
  }
  // A drive towards the wall, up to where Sight{} is.
  void Drive() {
    ASSERT_FALSE(OverAfter(2.0, [](double t_s) { return Sight{.scale = 0.8 + 0.1 * t_s}; }));
  }
  std::optional<StillPictureWatch> watch_{milliseconds(static_cast<int>(1000 * kLimit_s))};

 private:
  static double Level(const Sight& sight, int x, int y) {
    const double u = x - 0.5 * (kWidth_px - 1);
    const double v = y - 0.5 * (kHeight_px - 1);
    const double by_person = x - sight.person_left_px;
    if (by_person >= 0.0 && by_person < sight.person_px) {
      return GreyAt(Wall(1), 200.0 + by_person, 100.0 + y);
    }
    if (std::max(std::abs(u), std::abs(v)) > sight.painted_px * sight.scale) return 120.0;
    return GreyAt(Wall(0), 239.5 + (u - sight.right_px) / sight.scale, 179.5 + v / sight.scale);
  }

  std::mt19937 random_{7};
  SensorTime stamp_{seconds(100)};
};

TEST_F(StillPictureWatchTest, ADriveThatHasNotBegunIsNotOver) { EXPECT_FALSE(OverAfter(10.0)); }

TEST_F(StillPictureWatchTest, ADriveIsOverWhenTheRobotHasStoodForSoLong) {
  EXPECT_FALSE(OverAfter(5.0, Sight{.scale = 0.8}));
  Drive();
  EXPECT_FALSE(OverAfter(kLimit_s - 0.2));
  EXPECT_TRUE(OverAfter(0.5));
}

TEST_F(StillPictureWatchTest, APauseIsNoEnd) {
  Drive();
  EXPECT_FALSE(OverAfter(kLimit_s - 0.3));
  EXPECT_FALSE(OverAfter(2.0, [](double t_s) { return Sight{.scale = 1.0 + 0.1 * t_s}; }));
  EXPECT_FALSE(OverAfter(kLimit_s - 0.3, Sight{.scale = 1.2}));
  EXPECT_TRUE(OverAfter(0.6, Sight{.scale = 1.2}));
}

TEST_F(StillPictureWatchTest, ASlowDriveIsNotStanding) {
  Drive();
  EXPECT_FALSE(OverAfter(20.0, [](double t_s) { return Sight{.scale = 1.0 + 0.002 * t_s}; }));
}

TEST_F(StillPictureWatchTest, TurningSlowlyIsNotStanding) {
  Drive();
  EXPECT_FALSE(OverAfter(20.0, [](double t_s) { return Sight{.right_px = 0.5 * t_s}; }));
}

// The features near what the robot drives at hardly move.
TEST_F(StillPictureWatchTest, ADriveAtWhatIsSmallAndFarIsNotStanding) {
  Drive();
  EXPECT_FALSE(OverAfter(
      20.0, [](double t_s) { return Sight{.scale = 1.0 + 0.01 * t_s, .painted_px = 30.0}; }));
}

TEST_F(StillPictureWatchTest, ADriveAtABlankWallIsNotStanding) {
  for (const double noise_grey : {0.0, 3.0, 15.0}) {
    SCOPED_TRACE(noise_grey);
    Drive();
    EXPECT_FALSE(OverAfter(20.0, Sight{.noise_grey = noise_grey, .painted_px = 0.0}));
  }
}

TEST_F(StillPictureWatchTest, AStandBeforeWhatIsSmallEndsTheDrive) {
  Drive();
  EXPECT_TRUE(OverAfter(2.0 * kLimit_s, Sight{.painted_px = 40.0}));
}

TEST_F(StillPictureWatchTest, WhoWalksThroughThePictureDoesNotKeepADriveFromEnding) {
  Drive();
  const auto walks = [](double t_s) {
    return Sight{.person_left_px = -50.0 + 80.0 * t_s, .person_px = 50.0};
  };
  EXPECT_FALSE(OverAfter(kLimit_s - 0.2, walks));
  EXPECT_TRUE(OverAfter(0.5));
}

TEST_F(StillPictureWatchTest, WhoWalksToAndFroDoesNotEither) {
  Drive();
  const auto walks = [](double t_s) {
    return Sight{.person_left_px = 60.0 + 70.0 * std::sin(2.0 * t_s), .person_px = 45.0};
  };
  EXPECT_TRUE(OverAfter(kLimit_s + 1.0, walks));
}

TEST_F(StillPictureWatchTest, WhoHidesThePictureForAMomentDoesNotEither) {
  Drive();
  EXPECT_FALSE(OverAfter(1.0));
  EXPECT_FALSE(OverAfter(0.7, Sight{.person_px = 150.0}));
  EXPECT_FALSE(OverAfter(kLimit_s - 1.9));
  EXPECT_TRUE(OverAfter(0.5));
}

TEST_F(StillPictureWatchTest, WhoWalksThroughThePictureEndsNoDrive) {
  Drive();
  EXPECT_FALSE(OverAfter(20.0, [](double t_s) {
    return Sight{.scale = 1.0 + 0.02 * t_s,
                 .person_left_px = 60.0 + 70.0 * std::sin(2.0 * t_s),
                 .person_px = 45.0};
  }));
}

TEST_F(StillPictureWatchTest, WhoStandsBeforeTheRobotEndsNoDrive) {
  Drive();
  EXPECT_FALSE(OverAfter(20.0, [](double t_s) {
    return Sight{.scale = 1.0 + 0.02 * t_s, .person_left_px = 60.0, .person_px = 45.0};
  }));
}

// Nothing else is found again.
TEST_F(StillPictureWatchTest, AFastTurnIsNotStandingWhereTheCameraSeesTheRobotItself) {
  Drive();
  EXPECT_FALSE(OverAfter(20.0, [](double t_s) {
    return Sight{.right_px = 80.0 * std::sin(73.0 * t_s), .person_px = 45.0};
  }));
}

TEST_F(StillPictureWatchTest, ADriveThatLeavesLittleOfEachPictureHasBegun) {
  EXPECT_FALSE(OverAfter(0.6, [](double t_s) {
    return Sight{.right_px = 250.0 * (t_s - 0.6),
                 .person_left_px = t_s < 0.35 ? 10.0 : 90.0,
                 .person_px = 60.0};
  }));
  EXPECT_TRUE(OverAfter(kLimit_s + 2.5));
}

TEST_F(StillPictureWatchTest, APictureOfAnotherSizeTellsNothing) {
  Drive();
  EXPECT_FALSE(watch_->Over(SensorTime(seconds(200)), GrayImage{}));
  EXPECT_FALSE(watch_->Over(SensorTime(seconds(200)), Wall(0)));
  EXPECT_TRUE(OverAfter(kLimit_s + 0.5));
}

TEST_F(StillPictureWatchTest, WhoWalksThroughThePictureBeginsNoDrive) {
  EXPECT_FALSE(OverAfter(20.0, [](double t_s) {
    return Sight{.person_left_px = 60.0 + 70.0 * std::sin(2.0 * t_s), .person_px = 45.0};
  }));
}

TEST_F(StillPictureWatchTest, LightThatChangesDoesNotKeepADriveFromEnding) {
  Drive();
  EXPECT_FALSE(OverAfter(1.0));
  EXPECT_TRUE(OverAfter(kLimit_s + 2.5, Sight{.gain = 0.7}));
}

TEST_F(StillPictureWatchTest, WithoutALimitItIsNeverOver) {
  watch_.emplace(milliseconds(0));
  Drive();
  EXPECT_FALSE(OverAfter(20.0));
}

}  // namespace
}  // namespace trailcast::agent
