#include "route_server/fleet/photo_registry.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/await.h"
#include "tests/support/temp_dir.h"
#include "tests/unit/photos/a_photo.h"
#include "tests/unit/photos/held_disk.h"

namespace trailcast::server {
namespace {

using photos::APhoto;
using photos::Photo;
using photos::PhotoFolder;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

constexpr std::uint64_t kMost = 10'000'000;
constexpr std::size_t kBytes = 100;

// A photo of the robot of that number, which begins with it.
Photo PhotoOf(std::size_t number) {
  Photo photo = APhoto('a', photos::SomeJpeg(kBytes));
  photo.id = fmt::format("{:016x}", number);
  photo.robot = AgentId(fmt::format("robot{}", number));
  return photo;
}

exchange::PhotoPiece Whole(const Photo& photo) {
  return {.holder = photo.robot,
          .client = AgentId("server"),
          .photo = photo.id,
          .words = ToText(photo),
          .bytes = photos::SomeJpeg(kBytes)};
}

// Awaits what robots are told of so many photos.
std::vector<exchange::PhotoRequest> Kept(PhotoRegistry& registry, std::size_t photos) {
  std::vector<exchange::PhotoRequest> all;
  test::Await(
      [&] {
        for (auto& each : registry.TakeKept()) all.push_back(std::move(each));
        return all.size() >= photos;
      },
      "the photos are written");
  return all;
}

TEST(PhotoRegistryTest, AcknowledgesNothingBeforeItIsOnTheDisk) {
  const test::TempDir folder;
  photos::HeldDisk disk;
  PhotoRegistry registry(AgentId("server"), *PhotoFolder::Open(folder.path(), kMost, disk.Write()));
  const Photo photo = PhotoOf(1);
  EXPECT_FALSE(registry.Take(Whole(photo)));
  EXPECT_FALSE(registry.Take(Whole(photo))) << "it is sent again, and is being written";
  EXPECT_THAT(registry.TakeKept(), IsEmpty());
  EXPECT_THAT(registry.Answer({.words = "photos"}).lines, IsEmpty());
  disk.Let();
  const auto kept = Kept(registry, 1);
  ASSERT_THAT(kept, SizeIs(1));
  EXPECT_TRUE(kept.front().kept);
  EXPECT_EQ(kept.front().holder, photo.robot);
  EXPECT_EQ((*PhotoFolder::Open(folder.path(), kMost))->Get(photo.id), photo);
  EXPECT_TRUE(registry.Take(Whole(photo))->kept) << "its robot did not hear of it";
}

TEST(PhotoRegistryTest, MoreThanASlowDiskTakesAreRefusedAndTakenLater) {
  const test::TempDir folder;
  photos::HeldDisk disk;
  PhotoRegistry registry(AgentId("server"), *PhotoFolder::Open(folder.path(), kMost, disk.Write()));
  for (std::size_t i = 0; i < PhotoWriter::kMostWaiting; ++i) {
    EXPECT_FALSE(registry.Take(Whole(PhotoOf(i))));
  }
  const Photo more = PhotoOf(PhotoWriter::kMostWaiting);
  const auto refused = registry.Take(Whole(more)).value_or(exchange::PhotoRequest{});
  EXPECT_FALSE(refused.kept);
  EXPECT_THAT(refused.refusal, HasSubstr("wait for its disk"));
  disk.Let();
  for (const auto& each : Kept(registry, PhotoWriter::kMostWaiting)) EXPECT_TRUE(each.kept);
  EXPECT_FALSE(registry.Take(Whole(more)));
  EXPECT_TRUE(Kept(registry, 1).front().kept);
}

TEST(PhotoRegistryTest, APhotoThatCannotBeWrittenIsRefusedAndTakenAnew) {
  const test::TempDir folder;
  bool is_full = true;
  PhotoRegistry registry(
      AgentId("server"),
      *PhotoFolder::Open(folder.path(), kMost,
                         [&](const auto& file, const auto& text) -> Result<void> {
                           if (is_full) return Fail(ErrorCode::kUnavailable, "the disk is full");
                           return ReplaceFile(file, text);
                         }));
  const Photo photo = PhotoOf(1);
  EXPECT_FALSE(registry.Take(Whole(photo)));
  const auto refused = Kept(registry, 1);
  EXPECT_FALSE(refused.front().kept);
  EXPECT_EQ(refused.front().refusal, "the disk is full");
  is_full = false;
  EXPECT_FALSE(registry.Take(Whole(photo)));
  EXPECT_TRUE(Kept(registry, 1).front().kept);
}

}  // namespace
}  // namespace trailcast::server
