#include "services/base/durable_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>
#include <iterator>

#include "tests/support/temp_dir.h"

namespace trailcast {
namespace {

namespace fs = std::filesystem;

std::string TextIn(const fs::path& file) {
  std::ifstream stream(file);
  return {std::istreambuf_iterator<char>(stream), {}};
}

TEST(ReadBoundedFile, ReadsAllOfAFileThatIsNotTooLarge) {
  const test::TempDir folder;
  const std::string bytes("a\0b\r\n", 5);
  ASSERT_TRUE(ReplaceFile(folder / "note", bytes));
  EXPECT_EQ(ReadBoundedFile(folder / "note", 5).value(), bytes);
  const auto larger = ReadBoundedFile(folder / "note", 4);
  ASSERT_FALSE(larger);
  EXPECT_EQ(larger.error().code, ErrorCode::kCorrupt);
  EXPECT_EQ(larger.error().message,
            (folder / "note").string() + " is no file, or larger than 4 bytes");
  ASSERT_TRUE(ReplaceFile(folder / "long", std::string(200'000, 'x')));
  EXPECT_EQ(ReadBoundedFile(folder / "long", 1'000'000).value(), std::string(200'000, 'x'));
  ASSERT_TRUE(ReplaceFile(folder / "empty", ""));
  EXPECT_EQ(ReadBoundedFile(folder / "empty", 0).value(), "");
}

TEST(ReadBoundedFile, TellsWhatIsNotThereFromWhatIsNoFile) {
  const test::TempDir folder;
  const auto absent = ReadBoundedFile(folder / "absent", 9);
  ASSERT_FALSE(absent);
  EXPECT_EQ(absent.error().code, ErrorCode::kNotFound);
  EXPECT_THAT(absent.error().message,
              testing::StartsWith("cannot read " + (folder / "absent").string()));
  EXPECT_EQ(ReadBoundedFile(folder.path(), 9).error().code, ErrorCode::kCorrupt);
  EXPECT_EQ(ReadBoundedFile("/dev/zero", 9).error().code, ErrorCode::kCorrupt);
  ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
  EXPECT_EQ(ReadBoundedFile(folder / "pipe", 9).error().code, ErrorCode::kCorrupt)
      << "without waiting for anybody to write into it";
}

TEST(ReplaceFile, MakesAFileAndReplacesIt) {
  const test::TempDir folder;
  ASSERT_TRUE(ReplaceFile(folder / "note", "first\nand longer"));
  EXPECT_EQ(TextIn(folder / "note"), "first\nand longer");
  ASSERT_TRUE(ReplaceFile(folder / "note", "second"));
  EXPECT_EQ(TextIn(folder / "note"), "second");
  const auto files = fs::directory_iterator(folder.path());
  EXPECT_EQ(std::distance(begin(files), end(files)), 1) << "something is left beside it";
}

TEST(ReplaceFile, WhoHasTheOldOneOpenReadsOn) {
  const test::TempDir folder;
  ASSERT_TRUE(ReplaceFile(folder / "note", "first"));
  std::ifstream open_before(folder / "note");
  ASSERT_TRUE(ReplaceFile(folder / "note", "second"));
  std::string text;
  open_before >> text;
  EXPECT_EQ(text, "first");
}

TEST(ReplaceFile, GivesTheFileTheModeWhateverItWas) {
  const test::TempDir folder;
  ASSERT_TRUE(ReplaceFile(folder / "key", "for everybody"));
  ASSERT_TRUE(ReplaceFile(folder / "key", "for the owner", 0600));
  EXPECT_EQ(fs::status(folder / "key").permissions(),
            fs::perms::owner_read | fs::perms::owner_write);
}

TEST(ReplaceFile, WritesOverWhatAProcessOfThatNumberLeft) {
  const test::TempDir folder;
  std::ofstream(folder / fmt::format("note.{}.new", getpid())) << "cut off";
  ASSERT_TRUE(ReplaceFile(folder / "note", "whole"));
  EXPECT_EQ(TextIn(folder / "note"), "whole");
}

TEST(ReplaceFile, WhatCannotBeWrittenIsNamedAndNothingIsLeft) {
  const test::TempDir folder;
  const auto nowhere = ReplaceFile(folder / "no/note", "text");
  ASSERT_FALSE(nowhere);
  EXPECT_EQ(nowhere.error().code, ErrorCode::kUnavailable);
  EXPECT_THAT(nowhere.error().message, testing::HasSubstr((folder / "no/note").string()));
  // Nobody, root neither, puts a file where a folder with things in it is.
  fs::create_directories(folder / "taken" / "inside");
  EXPECT_FALSE(ReplaceFile(folder / "taken", "text"));
  EXPECT_FALSE(fs::exists(folder / fmt::format("taken.{}.new", getpid())));
}

TEST(SyncToDisk, TakesFilesAndFolders) {
  const test::TempDir folder;
  std::ofstream(folder / "file") << "text";
  EXPECT_FALSE(SyncToDisk(folder / "file"));
  EXPECT_FALSE(SyncToDisk(folder.path()));
  EXPECT_EQ(SyncToDisk(folder / "nothing"), std::errc::no_such_file_or_directory);
}

TEST(FolderOf, OfANameAloneIsWhereTheProgramIs) {
  EXPECT_EQ(FolderOf("routes.db"), ".");
  EXPECT_EQ(FolderOf("here/routes.db"), "here");
  EXPECT_EQ(FolderOf("/routes.db"), "/");
}

}  // namespace
}  // namespace trailcast
