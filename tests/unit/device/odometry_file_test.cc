#include "agent/device/odometry_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <numbers>

#include "tests/support/temp_dir.h"

namespace trailcast::agent {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class OdometryFileTest : public testing::Test {
 protected:
  Result<OdometryFile> Read(const std::string& text) {
    std::ofstream(folder_ / "odo.csv", std::ios::binary) << text;
    return OdometryFile::Read(folder_ / "odo.csv");
  }
  std::string ErrorOf(const std::string& text) {
    const auto read = Read(text);
    return read ? "no error" : read.error().message;
  }
  test::TempDir folder_;
};

TEST_F(OdometryFileTest, HeadingsInDegreesAreRefused) {
  const std::string header = "t_s,x_m,y_m,heading_rad\n";
  EXPECT_THAT(ErrorOf(header + "0,0,0,0\n0.05,0,0,1.4\n"),
              AllOf(HasSubstr("line 3"), HasSubstr("degrees")));
  EXPECT_EQ(ErrorOf(header + "0,0,0,3.14\n0.05,0,0,-3.13\n"), "no error") << "across pi";
  EXPECT_EQ(ErrorOf(header + "0,0,0,0\n0.05,0,0,0.1\n"), "no error");
}

TEST_F(OdometryFileTest, OdometryThatBeganAnewGoesOnFromWhereItWas) {
  std::string text = "t_s,x_m,y_m,heading_rad\n";
  for (int i = 0; i < 200; ++i) {  // at a metre a second
    const motion::Pose2 pose = i < 120 ? motion::Pose2{5.0 + 0.05 * i, 0.0, 0.0}
                                       : motion::Advance({0.0, 0.0, 2.0}, {0.05 * (i - 120), 0.0});
    text += fmt::format("{},{},{},{}\n", 0.05 * i, pose.x_m, pose.y_m, pose.heading_rad);
  }
  auto odometry = Read(text);
  ASSERT_TRUE(odometry) << odometry.error().message;
  const auto before = odometry->At(FromSeconds(5.9));
  const auto after = odometry->At(FromSeconds(6.9));
  ASSERT_TRUE(before && after);
  const auto driven = motion::IncrementBetween(*before, *after);
  EXPECT_NEAR(driven.distance_m, 0.95, 1e-6) << "but for the step that jumped";
  std::vector<std::string> news;
  EXPECT_EQ(odometry->TakeUnknown(FromSeconds(5.9), news).distance_m, 0.0);
  EXPECT_NEAR(odometry->TakeUnknown(FromSeconds(6.0), news).distance_m, 0.05, 1e-6);
  EXPECT_EQ(odometry->TakeUnknown(FromSeconds(9.0), news).distance_m, 0.0);
  ASSERT_EQ(news.size(), 1U);
  EXPECT_THAT(news[0], HasSubstr("odometry jumped by 10.95 m"));
}

TEST_F(OdometryFileTest, TimesOfNoClockAreRefused) {
  const std::string header = "t_s,x_m,y_m,heading_rad\n";
  for (const char* time : {"6.6e69", "-6.6e69", "1e19"}) {
    EXPECT_THAT(ErrorOf(header + time + ",0,0,0\n"),
                AllOf(HasSubstr("line 2"), HasSubstr("no time of any clock")));
  }
  EXPECT_EQ(ErrorOf(header + "1700000000.25,0,0,0\n"), "no error");
}

TEST_F(OdometryFileTest, AMarkAtTheFilesBeginningIsNoPartOfItsHeader) {
  EXPECT_EQ(ErrorOf("\xEF\xBB\xBFt_s,x_m,y_m,heading_rad\n0,0,0,0\n"), "no error");
}

TEST_F(OdometryFileTest, LinesMayEndAsTheyLike) {
  for (const char* end : {"\n", "\r\n", "\r"}) {
    const auto odometry = Read(fmt::format("t_s,x_m,y_m,heading_rad{0}0,0,0,0{0}1,2,0,0{0}", end));
    ASSERT_TRUE(odometry) << odometry.error().message;
    EXPECT_DOUBLE_EQ(odometry->At(FromSeconds(1.0))->x_m, 2.0);
  }
}

TEST_F(OdometryFileTest, WhatIsNoTextInUtf8IsToldSo) {
  const std::string header = "t_s,x_m,y_m,heading_rad\n0,0,0,0\n";
  std::string wide = "\xFF\xFE";
  for (const char c : header) wide += std::string{c, '\0'};
  EXPECT_THAT(ErrorOf(wide), AllOf(HasSubstr("odo.csv"), HasSubstr("UTF-16"), HasSubstr("UTF-8")));
  EXPECT_THAT(ErrorOf(header + '\0'), HasSubstr("no text"));
  EXPECT_LT(ErrorOf(std::string(100'000, 'x')).size(), 400U);
}

TEST_F(OdometryFileTest, TimesInOtherUnitsAreRefused) {
  const auto with_times = [](double factor) {
    std::string text = "t_s,x_m,y_m,heading_rad\n";
    for (int i = 0; i < 20; ++i) text += fmt::format("{},{},0,0\n", factor * i / 30, i / 30.0);
    return text;
  };
  EXPECT_EQ(ErrorOf(with_times(1.0)), "no error");
  EXPECT_THAT(ErrorOf(with_times(1000.0)),
              AllOf(HasSubstr("33.3333 s apart"), HasSubstr("milliseconds")));
  EXPECT_THAT(ErrorOf(with_times(1e6)), HasSubstr("microseconds"));
  EXPECT_THAT(ErrorOf(with_times(1e9)), HasSubstr("nanoseconds"));
}

TEST_F(OdometryFileTest, LengthsInOtherUnitsAreRefused) {
  const auto with_lengths = [](double factor) {
    std::string text = "t_s,x_m,y_m,heading_rad\n";
    for (int i = 0; i < 90; ++i) {  // it stands for a second, then drives at 1 m/s
      text += fmt::format("{},0,{},1.57\n", i / 30.0, factor * std::max(0, i - 30) / 30.0);
    }
    return text;
  };
  EXPECT_EQ(ErrorOf(with_lengths(1.0)), "no error");
  EXPECT_EQ(ErrorOf(with_lengths(36.0)), "no error") << "a car on a motorway";
  EXPECT_THAT(ErrorOf(with_lengths(1000.0)),
              AllOf(HasSubstr("odo.csv"), HasSubstr("1000 m/s"), HasSubstr("millimetres")));
  EXPECT_THAT(ErrorOf(with_lengths(100.0)), HasSubstr("100 m/s"));
}

TEST_F(OdometryFileTest, InterpolatesBetweenRows) {
  const auto odometry = Read("t_s,x_m,y_m,heading_rad\n0,0,0,0\n1,2,-4,0.5\n");
  ASSERT_TRUE(odometry) << odometry.error().message;
  const auto pose = odometry->At(FromSeconds(0.25));
  ASSERT_TRUE(pose);
  EXPECT_DOUBLE_EQ(pose->x_m, 0.5);
  EXPECT_DOUBLE_EQ(pose->y_m, -1.0);
  EXPECT_DOUBLE_EQ(pose->heading_rad, 0.125);
}

TEST_F(OdometryFileTest, TurnsTheShortWayAcrossPi) {
  const auto odometry = Read("t_s,x_m,y_m,heading_rad\r\n0,0,0,3.1\r\n1,0,0,-3.1\r\n");
  ASSERT_TRUE(odometry) << odometry.error().message;
  EXPECT_NEAR(std::abs(odometry->At(FromSeconds(0.5))->heading_rad), std::numbers::pi, 1e-9);
}

TEST_F(OdometryFileTest, HoldsTheEndsForHalfASecondAndFailsBeyond) {
  const auto odometry = Read("t_s,x_m,y_m,heading_rad,note\n0.1,1,0,0,ok\n1,2,0,0,ok\n");
  ASSERT_TRUE(odometry) << odometry.error().message;
  EXPECT_DOUBLE_EQ(odometry->At(FromSeconds(0.0))->x_m, 1.0);
  EXPECT_DOUBLE_EQ(odometry->At(FromSeconds(1.4))->x_m, 2.0);
  const auto beyond = odometry->At(FromSeconds(1.6));
  ASSERT_FALSE(beyond);
  EXPECT_THAT(beyond.error().message, AllOf(HasSubstr("1.60 s"), HasSubstr("--rate")));
}

TEST_F(OdometryFileTest, NamesTheLineThatIsWrong) {
  const std::string header = "t_s,x_m,y_m,heading_rad\n";
  EXPECT_THAT(ErrorOf("x,y\n0,0\n"), AllOf(HasSubstr("line 1"), HasSubstr("t_s,x_m")));
  EXPECT_THAT(ErrorOf(header), HasSubstr("no odometry"));
  EXPECT_THAT(ErrorOf(header + "0,0,0,0\n1,2,3\n"), HasSubstr("line 3"));
  EXPECT_THAT(ErrorOf(header + "0,0,0,0\n1,2,three,4\n"), HasSubstr("line 3"));
  EXPECT_THAT(ErrorOf(header + "0,0,0,nan\n"), HasSubstr("line 2"));
  EXPECT_THAT(ErrorOf(header + "1,0,0,0\n1,0,0,0\n"),
              AllOf(HasSubstr("line 3"), HasSubstr("does not come after")));
}

TEST_F(OdometryFileTest, SaysWhichFileIsMissing) {
  const auto read = OdometryFile::Read(folder_ / "none.csv");
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().code, ErrorCode::kNotFound);
  EXPECT_THAT(read.error().message, HasSubstr("none.csv"));
}

}  // namespace
}  // namespace trailcast::agent
