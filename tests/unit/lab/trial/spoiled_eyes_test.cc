#include "services/lab/trial/spoiled_eyes.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <iterator>
#include <vector>

#include "tests/support/walk_frames.h"

namespace trailcast::trial {
namespace {

using ::testing::HasSubstr;

TEST(SpoiledEyes, AMirroredPictureMirroredAgainIsThePicture) {
  const image::GrayImage picture = test::WalkFrame(0);
  image::GrayImage mirrored = picture;
  Spoil(Spoiled::kMirror, 1, mirrored);
  EXPECT_EQ(mirrored.at(0, 5), picture.at(picture.width - 1, 5));
  Spoil(Spoiled::kMirror, 1, mirrored);
  EXPECT_EQ(mirrored.pixels, picture.pixels);
}

TEST(SpoiledEyes, DirtCoversPartOfThePictureAndStaysWhereItIs) {
  const auto dirty_of = [](int frame) {
    image::GrayImage picture = test::WalkFrame(frame);
    const image::GrayImage clean = picture;
    Spoil(Spoiled::kDirt, 3, picture);
    std::vector<bool> dirty;
    for (std::size_t i = 0; i < clean.pixels.size(); ++i) {
      dirty.push_back(picture.pixels[i] != clean.pixels[i]);
    }
    return dirty;
  };
  const std::vector<bool> first = dirty_of(0);
  const auto covered = std::count(first.begin(), first.end(), true);
  EXPECT_GT(covered, std::ssize(first) / 6);
  EXPECT_LT(covered, std::ssize(first) / 2);
  const std::vector<bool> later = dirty_of(20);
  std::size_t apart = 0;
  for (std::size_t i = 0; i < first.size(); ++i) apart += first[i] != later[i] ? 1 : 0;
  EXPECT_LT(apart, first.size() / 50);
}

TEST(SpoiledEyes, WhatIsNoneIsAnErrorThatListsWhatThereIs) {
  ASSERT_TRUE(FindSpoiled(""));
  EXPECT_EQ(*FindSpoiled(""), Spoiled::kNothing);
  for (const std::string& name : SpoiledNames()) EXPECT_NE(*FindSpoiled(name), Spoiled::kNothing);
  const auto none = FindSpoiled("fog");
  ASSERT_FALSE(none);
  EXPECT_THAT(none.error().message, HasSubstr("mirror, dirt, aside"));
}

}  // namespace
}  // namespace trailcast::trial
