#include "services/photos/photo_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "tests/support/temp_dir.h"
#include "tests/unit/photos/a_photo.h"

namespace trailcast::photos {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
namespace fs = std::filesystem;

std::vector<std::string> IdsOf(const std::vector<Photo>& photos) {
  std::vector<std::string> ids;
  for (const Photo& photo : photos) ids.push_back(photo.id);
  return ids;
}

class PhotoFolderTest : public testing::Test {
 protected:
  static constexpr std::uint64_t kMost = 2500;

  std::unique_ptr<PhotoFolder> Open() { return *PhotoFolder::Open(folder_ / "photos", kMost); }

  test::TempDir folder_;
};

TEST_F(PhotoFolderTest, KeepsPhotosOverARestart) {
  const auto jpeg = SomeJpeg(1000);
  const Photo photo = APhoto('a', jpeg);
  ASSERT_TRUE(Open()->Add(photo, jpeg));
  const auto folder = Open();
  EXPECT_EQ(folder->Get(photo.id), photo);
  EXPECT_EQ(*folder->Read(photo.id, 0, 4000), jpeg);
  EXPECT_EQ(folder->Read(photo.id, 990, 4000)->size(), 10U);
  EXPECT_THAT(*folder->Read(photo.id, 1000, 4000), IsEmpty());
  EXPECT_EQ(folder->bytes(), 1000U);
}

TEST_F(PhotoFolderTest, MakesRoomByTheOldestAndSaysWhichWentAlsoAfterARestart) {
  const auto jpeg = SomeJpeg(1000);
  {
    const auto folder = Open();
    EXPECT_THAT(*folder->Add(APhoto('b', jpeg), jpeg), IsEmpty());
    EXPECT_THAT(*folder->Add(APhoto('a', jpeg), jpeg), IsEmpty());
    EXPECT_THAT(IdsOf(*folder->Add(APhoto('c', jpeg), jpeg)), ElementsAre(std::string(16, 'b')));
  }
  const auto folder = Open();
  EXPECT_THAT(IdsOf(folder->Find({})), ElementsAre(std::string(16, 'c'), std::string(16, 'a')));
  EXPECT_EQ(folder->First()->id, std::string(16, 'a'));
  EXPECT_EQ(folder->size(), 2U);
  EXPECT_FALSE(folder->Add(APhoto('d', SomeJpeg(2501)), SomeJpeg(2501)));
  EXPECT_EQ(folder->size(), 2U) << "one that can never fit drives none out";
}

TEST_F(PhotoFolderTest, KeepsTheFirstOfTwoThatAreCalledAlike) {
  const auto jpeg = SomeJpeg(1000);
  const auto folder = Open();
  ASSERT_TRUE(folder->Add(APhoto('a', jpeg), jpeg));
  ASSERT_TRUE(folder->Add(APhoto('a', SomeJpeg(500)), SomeJpeg(500)));
  EXPECT_EQ(folder->bytes(), 1000U);
}

TEST_F(PhotoFolderTest, DropsWhatALossOfPowerHasLeftAndLeavesOtherFilesAlone) {
  const auto jpeg = SomeJpeg(1000);
  ASSERT_TRUE(Open()->Add(APhoto('a', jpeg), jpeg));
  const fs::path place = folder_ / "photos";
  std::ofstream(place / (std::string(16, 'b') + ".jpg")) << "without words";
  std::ofstream(place / (std::string(16, 'c') + ".photo")) << "no photo";
  std::ofstream(place / "notes.jpg") << "somebody's";
  fs::resize_file(place / (std::string(16, 'a') + ".jpg"), 10);
  const auto folder = Open();
  EXPECT_EQ(folder->size(), 0U);
  EXPECT_FALSE(fs::exists(place / (std::string(16, 'b') + ".jpg")));
  EXPECT_TRUE(fs::exists(place / "notes.jpg"));
}

TEST_F(PhotoFolderTest, ForgetsWhatWasRemoved) {
  const auto jpeg = SomeJpeg(1000);
  const auto folder = Open();
  ASSERT_TRUE(folder->Add(APhoto('a', jpeg), jpeg));
  folder->Remove(std::string(16, 'a'));
  folder->Remove("nothing");
  EXPECT_FALSE(folder->First());
  EXPECT_EQ(folder->Read(std::string(16, 'a'), 0, 10).error().code, ErrorCode::kNotFound);
  EXPECT_TRUE(fs::is_empty(folder_ / "photos"));
}

TEST_F(PhotoFolderTest, SaysThatNothingCanBeWritten) {
  std::ofstream(folder_ / "photos") << "a file";
  const auto opened = PhotoFolder::Open(folder_ / "photos", kMost);
  ASSERT_FALSE(opened);
  EXPECT_EQ(opened.error().code, ErrorCode::kUnavailable);
}

}  // namespace
}  // namespace trailcast::photos
