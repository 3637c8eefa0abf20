#include "services/tool/odometry_checkup.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "services/route/usual_camera.h"

namespace trailcast::tool {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using Grade = Finding::Grade;

constexpr double kFrame_s = 0.05;
const double kUsualCamera_rad = FieldOfView(route::kUsualFocalShare);

// Forty seconds with turns to either side, at a pace.
class OdometryCheckupTest : public testing::Test {
 protected:
  using Lie = std::function<motion::VelocityCommand(double t_s)>;

  static motion::VelocityCommand Truth(double t_s) {
    return {0.5, 0.5 * std::sin(1.1 * t_s) + 0.4 * std::sin(0.37 * t_s)};
  }
  static agent::DriveLook Drive(const Lie& odometry = Truth) {
    agent::DriveLook drive;
    drive.has_odometry = true;
    drive.pictures = 801;
    drive.begins_s = 1000.0;
    for (int i = 1; i <= 800; ++i) {
      const double t_s = kFrame_s * i;
      const motion::VelocityCommand drives = Truth(t_s);
      const motion::VelocityCommand tells = odometry(t_s);
      odometry::DriveStep step;
      step.t_s = drive.begins_s + t_s;
      step.dt_s = kFrame_s;
      step.picture = odometry::PictureStep{drives.angular_radps * kFrame_s, 0.0, 0.01, 0.01};
      step.moved = {tells.linear_mps * kFrame_s, tells.angular_radps * kFrame_s};
      drive.steps.push_back(step);
    }
    return drive;
  }
  // All that is said but of what is good, and whether anything is bad.
  std::string Complaints(const agent::DriveLook& drive,
                         std::optional<double> field_of_view_rad = kUsualCamera_rad) {
    std::vector<Finding> findings = JudgeOdometry(drive, field_of_view_rad);
    std::erase_if(findings, [](const Finding& each) { return each.grade == Grade::kGood; });
    return CheckupText(findings);
  }
  static std::string Text(const agent::DriveLook& drive,
                          std::optional<double> field_of_view_rad = kUsualCamera_rad) {
    return CheckupText(JudgeOdometry(drive, field_of_view_rad));
  }
};

TEST_F(OdometryCheckupTest, HasNothingAgainstGoodOdometryAndSaysWhatItCannotTell) {
  EXPECT_EQ(Complaints(Drive()), "");
  EXPECT_THAT(Text(Drive()), AllOf(HasSubstr("drive: 40 s, 801 pictures; odometry drives 20.0 m"),
                                   HasSubstr("turns: odometry counts each 1.00 times"),
                                   HasSubstr("which pictures alone cannot tell")));
}

TEST_F(OdometryCheckupTest, WithoutAFieldOfViewSaysWhatItWouldHaveToBe) {
  EXPECT_EQ(Complaints(Drive(), std::nullopt), "");
  EXPECT_THAT(Text(Drive(), std::nullopt),
              AllOf(HasSubstr("if the camera sees 60 degrees across"), HasSubstr("--fov"),
                    Not(HasSubstr("counts each"))));
  const auto tenth = [](double t_s) {
    return motion::VelocityCommand{0.5, 0.1 * Truth(t_s).angular_radps};
  };
  EXPECT_THAT(Complaints(Drive(tenth), std::nullopt), HasSubstr("which hardly any does"));
}

TEST_F(OdometryCheckupTest, SaysHowLateItIsAndWhoseStampsToSet) {
  EXPECT_THAT(Complaints(Drive([](double t_s) { return Truth(t_s - 0.3); })),
              AllOf(HasSubstr("warn  delay: odometry turns 0.30 s after the picture"),
                    HasSubstr("have the base stamp")));
  EXPECT_THAT(Complaints(Drive([](double t_s) { return Truth(t_s + 0.3); })),
              AllOf(HasSubstr("0.30 s before the picture"), HasSubstr("have the camera's driver")));
}

TEST_F(OdometryCheckupTest, SaysHowFarItsTurnsAreOffAndWhatToMultiply) {
  const auto more = [](double t_s) {
    return motion::VelocityCommand{0.5, 1.3 * Truth(t_s).angular_radps};
  };
  EXPECT_THAT(Complaints(Drive(more)),
              AllOf(HasSubstr("warn  turns: odometry counts each 1.30 times"),
                    HasSubstr("multiply its wheel separation"), HasSubstr("by 1.30")));
  const auto less = [](double t_s) {
    return motion::VelocityCommand{0.5, 0.8 * Truth(t_s).angular_radps};
  };
  EXPECT_THAT(Complaints(Drive(less)), HasSubstr("counts each 0.80 times"));
}

TEST_F(OdometryCheckupTest, TurnsToTheWrongSideAreBad) {
  const auto mirrored = [](double t_s) {
    return motion::VelocityCommand{0.5, -Truth(t_s).angular_radps};
  };
  EXPECT_THAT(
      Complaints(Drive(mirrored), std::nullopt),
      AllOf(HasSubstr("BAD   turns: odometry turns to the other side"), HasSubstr("REP 103")));
}

TEST_F(OdometryCheckupTest, OdometryThatNeverTurnsAndThatOfAnotherDriveAreBad) {
  EXPECT_THAT(Complaints(Drive([](double) {
                return motion::VelocityCommand{0.5, 0.0};
              })),
              HasSubstr("BAD   turns: odometry hardly turns while the picture does"));
  EXPECT_THAT(Complaints(Drive([](double t_s) {
                return motion::VelocityCommand{0.5, 0.7 * std::sin(0.11 * t_s * t_s)};
              })),
              HasSubstr("BAD   turns: odometry's have nothing to do with the picture's"));
}

TEST_F(OdometryCheckupTest, TellsAGyrosBias) {
  const auto biased = [](double t_s) {
    return motion::VelocityCommand{0.5, Truth(t_s).angular_radps + 0.1};
  };
  EXPECT_THAT(Complaints(Drive(biased)),
              HasSubstr("warn  drift: 5.7 degrees a second to the left that the picture does not "
                        "show, or 11.5 a metre"));
}

TEST_F(OdometryCheckupTest, TellsWhenItWasFrozenAndSlippedAndJumped) {
  EXPECT_THAT(Complaints(Drive([](double t_s) {
                return t_s > 20.0 && t_s < 22.0 ? motion::VelocityCommand{} : Truth(t_s);
              })),
              HasSubstr("warn  frozen: odometry stands while the picture moves, from 20.0 s for "));
  EXPECT_THAT(Complaints(Drive([](double t_s) {
                motion::VelocityCommand tells = Truth(t_s);
                if (t_s > 20.0 && t_s < 21.0) tells.angular_radps += 0.8;
                return tells;
              })),
              HasSubstr("degrees too far to the left"));
  agent::DriveLook drive = Drive();
  for (const std::size_t at : {99U, 199U, 299U, 399U}) drive.steps[at].odometry_broke = true;
  EXPECT_THAT(Complaints(drive),
              HasSubstr("jumps: odometry jumps, or is silent, at 5.0 s; 10.0 s; 15.0 s; and 1 "
                        "more"));
}

TEST_F(OdometryCheckupTest, PassesOnWhatTheDeviceHasFound) {
  agent::DriveLook drive = Drive();
  drive.news = {"the stamps of /odom step by +3.00 s"};
  EXPECT_THAT(Complaints(drive), HasSubstr("the stamps of /odom step by +3.00 s"));
}

TEST_F(OdometryCheckupTest, HoldsMetresAgainstWhatTheBaseWasTold) {
  agent::DriveLook drive = Drive();
  for (odometry::DriveStep& step : drive.steps) step.told = motion::VelocityCommand{0.5, 0.0};
  EXPECT_EQ(Complaints(drive), "");
  EXPECT_THAT(Text(drive), HasSubstr("1.00 times as far"));
  for (odometry::DriveStep& step : drive.steps) step.told = motion::VelocityCommand{0.35, 0.0};
  EXPECT_THAT(Complaints(drive), AllOf(HasSubstr("1.43 times as far"), HasSubstr("tape measure")));
}

TEST_F(OdometryCheckupTest, AsksForMoreOfADriveThatTellsTooLittle) {
  agent::DriveLook drive = Drive();
  for (odometry::DriveStep& step : drive.steps) step.picture.reset();
  EXPECT_THAT(Complaints(drive), HasSubstr("only 0 % of the pictures"));
  drive = Drive([](double) { return motion::VelocityCommand{}; });
  for (odometry::DriveStep& step : drive.steps) step.picture = odometry::PictureStep{};
  EXPECT_THAT(Complaints(drive), HasSubstr("too little to judge turns by"));
  EXPECT_THAT(Complaints(drive), Not(HasSubstr("BAD")));
  drive.has_odometry = false;
  EXPECT_THAT(Complaints(drive), HasSubstr("BAD   odometry: there is none"));
}

}  // namespace
}  // namespace trailcast::tool
