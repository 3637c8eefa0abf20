#include "services/archive/route_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "services/archive/route_file_writer.h"
#include "tests/support/temp_dir.h"
#include "tests/unit/archive/made_file.h"

namespace trailcast::archive {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using Existing = RouteFileWriter::Existing;

class RouteFileTest : public testing::Test {
 protected:
  Result<std::uint64_t> Export(const test::TaughtRoute& taught, Existing existing) {
    auto writer = RouteFileWriter::Create(file_, taught.info, existing);
    if (!writer) return tl::unexpected(writer.error());
    for (const auto& piece : taught.pieces) {
      if (auto added = writer->Add(piece); !added) return tl::unexpected(added.error());
    }
    return writer->Finish();
  }
  // Names in the folder.
  [[nodiscard]] std::vector<std::string> Left() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder_.path())) {
      names.push_back(entry.path().filename());
    }
    return names;
  }

  test::TempDir folder_;
  const std::filesystem::path file_ = folder_ / "hall.trailcast";
  const test::TaughtRoute taught_ = test::TeachSamples(5, 20);
};

TEST_F(RouteFileTest, GivesBackTheRouteThatWasWritten) {
  const auto size = Export(taught_, Existing::kKeep);
  ASSERT_TRUE(size) << size.error().message;
  EXPECT_EQ(*size, std::filesystem::file_size(file_));
  EXPECT_THAT(Left(), testing::ElementsAre("hall.trailcast"));
  const auto file = RouteFile::Open(file_);
  ASSERT_TRUE(file) << file.error().message;
  EXPECT_EQ(file->info(), taught_.info);
  EXPECT_EQ(file->file_bytes(), *size);
  for (const auto& piece : taught_.pieces) EXPECT_EQ(file->ReadSegment(piece.index).value(), piece);
  EXPECT_EQ(file->ReadSegment(SegmentIndex(5)).error().code, ErrorCode::kNotFound);
}

TEST_F(RouteFileTest, IsTheSameFromMemory) {
  const route::Bytes bytes = MadeFile::Of(taught_).Bytes();
  const auto file = RouteFile::Open(bytes);
  ASSERT_TRUE(file) << file.error().message;
  EXPECT_EQ(file->info(), taught_.info);
  ASSERT_TRUE(Export(taught_, Existing::kKeep));
  EXPECT_EQ(ReadFile(file_), bytes);
}

TEST_F(RouteFileTest, KeepsAFileThatIsThereUnlessToldToReplaceIt) {
  WriteFile(file_, {1, 2, 3});
  const auto refused = Export(taught_, Existing::kKeep);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kConflict);
  EXPECT_THAT(refused.error().message, AllOf(HasSubstr(file_.string()), HasSubstr("--force")));
  EXPECT_EQ(ReadFile(file_), (route::Bytes{1, 2, 3}));
  ASSERT_TRUE(Export(taught_, Existing::kReplace));
  EXPECT_TRUE(RouteFile::Open(file_));
}

TEST_F(RouteFileTest, KeepsAFileThatAppearedMeanwhile) {
  auto writer = RouteFileWriter::Create(file_, taught_.info, Existing::kKeep);
  ASSERT_TRUE(writer);
  for (const auto& piece : taught_.pieces) ASSERT_TRUE(writer->Add(piece));
  WriteFile(file_, {1, 2, 3});
  const auto finished = writer->Finish();
  ASSERT_FALSE(finished);
  EXPECT_EQ(finished.error().code, ErrorCode::kConflict);
  EXPECT_EQ(ReadFile(file_), (route::Bytes{1, 2, 3}));
}

TEST_F(RouteFileTest, ReplacesNoFolder) {
  std::filesystem::create_directory(file_);
  const auto refused = Export(taught_, Existing::kReplace);
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message, HasSubstr("is a folder or a device"));
}

TEST_F(RouteFileTest, LeavesNothingBehindWithoutFinish) {
  {
    auto writer = RouteFileWriter::Create(file_, taught_.info, Existing::kKeep);
    ASSERT_TRUE(writer);
    ASSERT_TRUE(writer->Add(taught_.pieces[0]));
    EXPECT_EQ(Left().size(), 1U);
  }
  EXPECT_TRUE(Left().empty());
}

TEST_F(RouteFileTest, SaysThatItsFolderIsNotThere) {
  const auto writer =
      RouteFileWriter::Create(folder_ / "no/hall.trailcast", taught_.info, Existing::kKeep);
  ASSERT_FALSE(writer);
  EXPECT_EQ(writer.error().code, ErrorCode::kUnavailable);
  EXPECT_THAT(writer.error().message, HasSubstr("No such file or directory"));
}

TEST_F(RouteFileTest, IsNotWrittenOfARouteStillBeingTaught) {
  test::TaughtRoute teaching = taught_;
  teaching.info.state = route::RouteState::kTeaching;
  const auto refused = Export(teaching, Existing::kKeep);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kInvalidArgument);
  EXPECT_THAT(refused.error().message,
              AllOf(HasSubstr("'hall' revision 2 is still being taught (5 segments"),
                    HasSubstr("only complete routes")));
}

TEST_F(RouteFileTest, IsNotWrittenOfSegmentsThatAreNotTheRoutes) {
  test::TaughtRoute short_of_one = taught_;
  short_of_one.pieces.pop_back();
  EXPECT_THAT(Export(short_of_one, Existing::kKeep).error().message, HasSubstr("cut short"));

  test::TaughtRoute swapped = taught_;
  std::swap(swapped.pieces[1], swapped.pieces[2]);
  EXPECT_THAT(Export(swapped, Existing::kKeep).error().message,
              HasSubstr("segment 2 of route 00112233445566778899aabbccddeeff is not the next"));

  test::TaughtRoute damaged = taught_;
  damaged.pieces[3].bytes[7] ^= 1U;
  EXPECT_THAT(Export(damaged, Existing::kKeep).error().message, HasSubstr("segment 3"));

  test::TaughtRoute other = taught_;
  other.info.manifest_digest[0] ^= 1U;
  EXPECT_THAT(Export(other, Existing::kKeep).error().message, HasSubstr("manifest"));
  EXPECT_TRUE(Left().empty());
}

TEST_F(RouteFileTest, IsNeverWrittenTooLarge) {
  test::TaughtRoute huge = taught_;
  huge.info.bytes = kMaxFileBytes;
  EXPECT_THAT(Export(huge, Existing::kKeep).error().message, HasSubstr("too many for a file"));
  huge.info.bytes = ~std::uint64_t{0};
  EXPECT_THAT(Export(huge, Existing::kKeep).error().message, HasSubstr("bytes in a route"));
}

TEST_F(RouteFileTest, NoticesThatItWasChangedAfterItWasOpened) {
  ASSERT_TRUE(Export(taught_, Existing::kKeep));
  const auto file = RouteFile::Open(file_);
  ASSERT_TRUE(file);
  route::Bytes bytes = ReadFile(file_);
  bytes[bytes.size() - kChecksumBytes - 1] ^= 1U;  // of the last segment
  WriteFile(file_, bytes);
  const auto changed = file->ReadSegment(SegmentIndex(4));
  ASSERT_FALSE(changed);
  EXPECT_EQ(changed.error().code, ErrorCode::kCorrupt);
  std::filesystem::resize_file(file_, 100);
  EXPECT_THAT(file->ReadSegment(SegmentIndex(4)).error().message, HasSubstr("became shorter"));
}

TEST_F(RouteFileTest, IsNoFolderNoPipeAndMustBeThere) {
  EXPECT_EQ(RouteFile::Open(file_).error().code, ErrorCode::kNotFound);
  EXPECT_THAT(RouteFile::Open(folder_.path()).error().message, HasSubstr("expected a file"));
  ASSERT_EQ(mkfifo(file_.c_str(), 0600), 0);
  EXPECT_THAT(RouteFile::Open(file_).error().message, HasSubstr("expected a file"));
}

}  // namespace
}  // namespace trailcast::archive
