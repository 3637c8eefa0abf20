#include "services/lab/simulated/camera_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "tests/support/temp_dir.h"

namespace trailcast::agent {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class CameraFileTest : public testing::Test {
 protected:
  Result<sim::CameraModel> Read(const std::string& text) {
    std::ofstream(folder_ / "mine.toml") << text;
    return CameraFromWord((folder_ / "mine.toml").string());
  }
  std::string ErrorOf(const std::string& text) {
    const auto read = Read(text);
    return read ? "no error" : read.error().message;
  }
  test::TempDir folder_;
};

TEST_F(CameraFileTest, ReadsEveryKey) {
  const auto camera = Read(
      "# a fisheye on a pole\nwidth = 480\nheight=360\nmodel = \"fisheye\"\nhfov_deg = 170.5\n"
      "distortion = 0.1\nheight_m = 1.2\nyaw_deg = -3\npitch_deg = 4\n");
  ASSERT_TRUE(camera) << camera.error().message;
  EXPECT_EQ(camera->name, "mine");
  EXPECT_EQ(camera->width, 480);
  EXPECT_EQ(camera->height, 360);
  EXPECT_EQ(camera->model, sim::LensModel::kFisheye);
  EXPECT_DOUBLE_EQ(camera->horizontal_fov_deg, 170.5);
  EXPECT_DOUBLE_EQ(camera->distortion, 0.1);
  EXPECT_DOUBLE_EQ(camera->height_m, 1.2);
  EXPECT_DOUBLE_EQ(camera->yaw_deg, -3.0);
  EXPECT_DOUBLE_EQ(camera->pitch_deg, 4.0);
}

TEST_F(CameraFileTest, AWordSaysWhatIsOtherAboutACamera) {
  const auto camera = CameraFromWord("wide+roll_deg=180+ahead_m=0.3+knock_yaw_deg=-5+knock_at_s=9");
  ASSERT_TRUE(camera) << camera.error().message;
  EXPECT_EQ(camera->name, "wide+roll_deg=180+ahead_m=0.3+knock_yaw_deg=-5+knock_at_s=9");
  EXPECT_DOUBLE_EQ(camera->horizontal_fov_deg, 110.0);
  EXPECT_DOUBLE_EQ(camera->roll_deg, 180.0);
  EXPECT_DOUBLE_EQ(camera->ahead_m, 0.3);
  EXPECT_DOUBLE_EQ(camera->knock_yaw_deg, -5.0);
  EXPECT_DOUBLE_EQ(camera->knock_at_s, 9.0);
  EXPECT_DOUBLE_EQ(CameraFromWord("webcam+exposure_swing=2")->exposure_swing, 2.0);
  EXPECT_DOUBLE_EQ(CameraFromWord("webcam+centre_u=0.05")->centre_u, 0.05);
  const auto unknown = CameraFromWord("webcam+tilt=3");
  ASSERT_FALSE(unknown);
  EXPECT_THAT(unknown.error().message, AllOf(HasSubstr("webcam+tilt=3"), HasSubstr("roll_deg")));
  EXPECT_FALSE(CameraFromWord("webcam+roll_deg=upside"));
}

TEST_F(CameraFileTest, AFilesWordMayGoOnAndItsNameHaveAPlus) {
  std::ofstream(folder_ / "mine+1.toml") << "yaw_deg = 2\n";
  const std::string file = (folder_ / "mine+1.toml").string();
  EXPECT_EQ(CameraFromWord(file)->name, "mine+1");
  const auto camera = CameraFromWord(file + "+roll_deg=-4");
  ASSERT_TRUE(camera) << camera.error().message;
  EXPECT_EQ(camera->name, "mine+1+roll_deg=-4");
  EXPECT_DOUBLE_EQ(camera->yaw_deg, 2.0);
  EXPECT_DOUBLE_EQ(camera->roll_deg, -4.0);
}

TEST_F(CameraFileTest, NamesAnUnknownKeyAndThoseAccepted) {
  EXPECT_THAT(ErrorOf("width = 320\nfocal = 3\n"),
              AllOf(HasSubstr("'focal'"), HasSubstr("hfov_deg"), HasSubstr("mine.toml")));
  EXPECT_THAT(ErrorOf("[lens]\nwidth = 320\n"), HasSubstr("'lens.width'"));
}

TEST_F(CameraFileTest, RefusesValuesThatAreNone) {
  EXPECT_THAT(ErrorOf("width = wide\n"), AllOf(HasSubstr("'width'"), HasSubstr("whole number")));
  EXPECT_THAT(ErrorOf("hfov_deg = nan\n"), HasSubstr("'hfov_deg'"));
  EXPECT_THAT(ErrorOf("model = \"telescope\"\n"), HasSubstr("telescope"));
  EXPECT_THAT(ErrorOf("width = -5\n"), HasSubstr("mine.toml"));
}

TEST_F(CameraFileTest, SaysThatTextOfAnotherEncodingBehindAByteOrderMarkIsNotRead) {
  EXPECT_THAT(ErrorOf("\xEF\xBB\xBF\xFF\xFEw"), AllOf(HasSubstr("mine.toml"), HasSubstr("UTF-16")));
}

TEST_F(CameraFileTest, KnowsTheBuiltInCamerasByName) {
  EXPECT_EQ(CameraFromWord("wide")->width, 320);
  const auto unknown = CameraFromWord("kodak");
  ASSERT_FALSE(unknown);
  EXPECT_THAT(unknown.error().message,
              AllOf(HasSubstr("kodak"), HasSubstr("webcam"), HasSubstr(".toml")));
}

}  // namespace
}  // namespace trailcast::agent
