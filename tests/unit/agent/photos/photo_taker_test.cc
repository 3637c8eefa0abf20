#include "agent/photos/photo_taker.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "agent/follow/follower.h"
#include "services/image/files.h"
#include "tests/support/await.h"
#include "tests/support/temp_dir.h"
#include "tests/unit/agent/swarm.h"

namespace trailcast::agent {
namespace {

using photos::Photo;
using photos::PhotoFolder;
using test::WalkDevice;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr int kTaughtFrames = 150;    // of 2 cm
constexpr int kFollowedFrames = 220;  // it arrives before

class PhotoTakerTest : public testing::Test {
 protected:
  void Teach() {
    WalkDevice scout(kTaughtFrames);
    const auto summary = swarm_.Teach(scout, swarm_.ScoutNamed("robot"), false);
    ASSERT_TRUE(summary) << summary.error().message;
  }
  // Follows the route, and returns the photos in the order in which they were taken.
  std::vector<Photo> Follow(const char* orders, WalkDevice& device) {
    {
      PhotoTaker taker(*folder_);
      PhotoRun run(taker, mission::PhotosIn(orders), AgentId("robot"), "m1", false);
      FollowerOptions options = swarm_.FollowerNamed("robot");
      options.photos = &run;
      const auto outcome = swarm_.Replay(device, options, false);
      EXPECT_TRUE(outcome) << outcome.error().message;
      taken_ = run.taken();
    }
    auto found = folder_->Find({});
    std::sort(found.begin(), found.end(),
              [](const Photo& a, const Photo& b) { return a.along_m < b.along_m; });
    return found;
  }

  test::TempDir place_;
  std::unique_ptr<PhotoFolder> folder_ = *PhotoFolder::Open(place_ / "photos", 10'000'000);
  test::Swarm swarm_;
  int taken_ = 0;
};

TEST_F(PhotoTakerTest, KeepsPhotosOfAMissionWithPlaceTimeAndMission) {
  Teach();
  WalkDevice device(kFollowedFrames);
  const auto kept = Follow("photo every 1 at shelf=hall@1.5 follow hall", device);
  std::vector<std::string> spots;
  for (const Photo& photo : kept) {
    spots.push_back(SpotText(photo));
    EXPECT_EQ(photo.robot, AgentId("robot"));
    EXPECT_EQ(photo.mission, "m1");
    EXPECT_EQ(photo.route, "hall");
    EXPECT_NEAR(photo.along_m, photo.spot_m, PhotoPlan::kNear_m);
    EXPECT_GT(photo.taken_unix_ms, 1'600'000'000'000);
    const auto jpeg = folder_->Read(photo.id, 0, photo.bytes);
    ASSERT_TRUE(jpeg);
    const auto picture = image::DecodeGray(*jpeg, "photo");
    ASSERT_TRUE(picture) << picture.error().message;
    EXPECT_EQ(picture->width, 160) << "as large as the camera's";
    EXPECT_EQ(picture->height, 120);
  }
  EXPECT_THAT(spots, testing::IsSupersetOf({"hall@1", "shelf", "hall@2"}));
  EXPECT_EQ(taken_, static_cast<int>(kept.size()));
}

TEST_F(PhotoTakerTest, KeepsThePhotosOfARunThatIsBrokenOff) {
  Teach();
  WalkDevice device(kFollowedFrames);
  device.before_frame = [](int frame) -> Result<void> {
    if (frame < kTaughtFrames / 2) return {};
    return Fail(ErrorCode::kUnavailable, "the camera is gone");
  };
  const auto kept = Follow("photo every 1 follow hall", device);
  ASSERT_FALSE(kept.empty());
  EXPECT_LT(kept.back().along_m, 1.6);
}

// A picture that no bound can hold is missing, the reason is told, and the others are kept.
TEST_F(PhotoTakerTest, SaysWhyAPhotoIsNotKeptAndWhichHadToGo) {
  std::vector<std::string> news;
  {
    folder_ = *PhotoFolder::Open(place_ / "small", 3000);
    PhotoTaker taker(*folder_);
    image::GrayImage grey{160, 120, {}};
    grey.pixels.assign(160 * 120, 128);
    const auto take = [&](const image::GrayImage& picture) {
      while (!taker.Take({.robot = AgentId("robot"), .mission = "m1", .route = "hall"}, picture)) {
      }
    };
    take({});
    for (int i = 0; i < 40; ++i) take(grey);
    EXPECT_TRUE(test::Await(
        [&] {
          for (std::string& line : taker.TakeNews()) news.push_back(std::move(line));
          return news.size() >= 2;
        },
        "what became of the photos"));
  }
  ASSERT_GE(news.size(), 2U);
  EXPECT_THAT(news[0], HasSubstr("a photo was not kept: a picture of 0x0 pixels"));
  EXPECT_THAT(news[1], HasSubstr("the folder of photos is full: 1 of them went"));
  EXPECT_GT(folder_->size(), 0U);
  EXPECT_LE(folder_->bytes(), 3000U);
}

}  // namespace
}  // namespace trailcast::agent
