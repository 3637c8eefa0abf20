#include "services/lab/trial/align/align.h"

#include <gmock/gmock.h>

#include "services/image/files.h"
#include "tests/support/painted_wall.h"
#include "tests/support/temp_dir.h"

namespace trailcast::trial {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr int kStep_px = 50;  // of the wall, from one place of the route to the next
constexpr int kPlaces = 8;

// A robot that passes a painted wall, looking at it, place after place.
class AlignTest : public testing::Test {
 protected:
  // A recording of those places; each view is so much further right. -1 is another wall.
  std::filesystem::path Record(const std::string& name, const std::vector<int>& places,
                               double du_px = 0.0) {
    std::filesystem::create_directories(folder_ / name);
    for (std::size_t i = 0; i < places.size(); ++i) {
      const double along_px = kStep_px * (places[i] - 0.5 * (kPlaces - 1));
      const test::PaintedWall& wall = places[i] < 0 ? elsewhere_ : wall_;
      const image::GrayImage frame =
          wall.Photograph({.du_px = du_px - (places[i] < 0 ? 0.0 : along_px),
                           .noise_grey = 1.5,
                           .width = 160,
                           .height = 120,
                           .noise_seed = static_cast<unsigned>(i + places.size())});
      const auto file = folder_ / name / (std::to_string(1000 + i) + ".png");
      if (auto written = image::WritePng(frame, file); !written) {
        throw std::runtime_error(written.error().message);
      }
    }
    return folder_ / name;
  }
  Reference Found(const std::filesystem::path& replay, AlignOptions options = {}) {
    if (options.every == AlignOptions{}.every) options.every = options.teach_every = 1;
    const auto aligned =
        Align(Record("teach", All()), replay, options, [](const char*, double) { return true; });
    EXPECT_TRUE(aligned) << aligned.error().message;
    return aligned.value_or(Aligned{}).reference;
  }
  static std::vector<int> All() {
    std::vector<int> places;
    for (int i = 0; i < kPlaces; ++i) places.push_back(i);
    return places;
  }
  static std::vector<int> TeachFrames(const Reference& reference) {
    std::vector<int> frames;
    for (const Alignment& row : reference) frames.push_back(row.teach_frame);
    return frames;
  }

  const test::PaintedWall wall_{4, 400};
  const test::PaintedWall elsewhere_{9, 400};
  test::TempDir folder_;
};

TEST_F(AlignTest, FindsEachPlaceAndItsSide) {
  const Reference found = Found(Record("replay", {1, 2, 3, 4, 6, 6, 7}, 5.0));
  EXPECT_THAT(TeachFrames(found), ElementsAre(1, 2, 3, 4, 6, 6, 7));
  for (const Alignment& row : found) {
    EXPECT_TRUE(row.good) << row.replay_frame;
    EXPECT_NEAR(row.median_du_px, 5.0, 0.7) << row.replay_frame;
  }
}

TEST_F(AlignTest, ALapMayEndAndBeginAgain) {
  const Reference found = Found(Record("replay", {4, 5, 6, 7, 0, 1, 2, 3}, -4.0));
  EXPECT_THAT(TeachFrames(found), ElementsAre(4, 5, 6, 7, 0, 1, 2, 3));
  for (const Alignment& row : found) EXPECT_NEAR(row.median_du_px, -4.0, 0.7);
}

TEST_F(AlignTest, WhatWasTakenElsewhereIsNotGood) {
  const Reference found = Found(Record("replay", {2, 3, -1, -1, 6, 7}));
  ASSERT_EQ(found.size(), 6U);
  EXPECT_TRUE(found[1].good);
  EXPECT_FALSE(found[2].good);
  EXPECT_FALSE(found[3].good);
  EXPECT_TRUE(found[4].good);
  EXPECT_EQ(found[4].teach_frame, 6);
}

TEST_F(AlignTest, LongRecordingsAreComparedNearThePlaceHeldAndFoundAgain) {
  AlignOptions options;
  options.most_pairs = 1;
  const Reference found =
      Found(Record("replay", {0, 1, 2, 3, -1, -1, -1, -1, -1, 4, 5, 6, 7}, 5.0), options);
  const std::vector<int> frames = TeachFrames(found);
  ASSERT_EQ(frames.size(), 13U);
  EXPECT_EQ(std::vector<int>(frames.begin(), frames.begin() + 4), (std::vector<int>{0, 1, 2, 3}));
  EXPECT_EQ(std::vector<int>(frames.begin() + 9, frames.end()), (std::vector<int>{4, 5, 6, 7}));
}

TEST_F(AlignTest, LooksAtEverySoManyFrames) {
  AlignOptions options;
  options.every = 3;
  options.teach_every = 2;
  const Reference found = Found(Record("replay", {0, 1, 1, 2, 3, 3, 4}), options);
  ASSERT_EQ(found.size(), 3U);
  EXPECT_EQ(found[1].replay_frame, 3);
  EXPECT_THAT(TeachFrames(found), ElementsAre(0, 2, 4));
}

TEST_F(AlignTest, ThreadsChangeNothing) {
  const auto replay = Record("replay", {0, 2, 4, 6}, 3.0);
  AlignOptions options;
  options.jobs = 3;
  const Reference alone = Found(replay);
  const Reference together = Found(replay, options);
  ASSERT_EQ(alone.size(), together.size());
  for (std::size_t i = 0; i < alone.size(); ++i) {
    EXPECT_EQ(alone[i].teach_frame, together[i].teach_frame);
    EXPECT_EQ(alone[i].inliers, together[i].inliers);
    EXPECT_EQ(alone[i].median_du_px, together[i].median_du_px);
  }
}

TEST_F(AlignTest, TellsHowFarItIsAndEndsWhenAsked) {
  const auto recording = Record("teach", {0, 1, 2});
  std::vector<std::string> told;
  const auto ended = Align(recording, recording, {}, [&](const char* doing, double share) {
    EXPECT_GE(share, 0.0);
    EXPECT_LE(share, 1.0);
    told.emplace_back(doing);
    return told.size() < 3;
  });
  ASSERT_FALSE(ended);
  EXPECT_THAT(ended.error().message, HasSubstr("interrupted"));
  EXPECT_THAT(told,
              ElementsAre("looking at the taught one", "looking at the replayed one", "comparing"));
}

TEST_F(AlignTest, SaysWhichRecordingIsNotThere) {
  const auto absent =
      Align(folder_ / "absent", folder_ / "absent", {}, [](const char*, double) { return true; });
  ASSERT_FALSE(absent);
  EXPECT_THAT(absent.error().message, HasSubstr("absent"));
}

}  // namespace
}  // namespace trailcast::trial
