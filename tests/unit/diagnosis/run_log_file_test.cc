#include "agent/diagnosis/run_log_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <future>
#include <sstream>
#include <stdexcept>

#include "tests/support/await.h"
#include "tests/support/temp_dir.h"

namespace trailcast::agent {
namespace {

using std::chrono::steady_clock;
using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

std::string TextOf(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

TEST(RunLogFile, WhatWasPutIsOnTheDiskWhileTheRunGoesOn) {
  const test::TempDir folder;
  auto file = RunLogFile::Create(folder / "run.log");
  ASSERT_TRUE(file) << file.error().message;
  (*file)->Put("first\n");
  (*file)->Put("second\n");
  const auto deadline = steady_clock::now() + test::kLongEnough;
  while (TextOf(folder / "run.log").size() < 13 && steady_clock::now() < deadline) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  EXPECT_EQ(TextOf(folder / "run.log"), "first\nsecond\n") << "not closed yet";
}

TEST(RunLogFile, ClosedItHoldsAllThatWasPutInOrder) {
  const test::TempDir folder;
  auto file = RunLogFile::Create(folder / "run.log");
  ASSERT_TRUE(file);
  std::string all;
  for (int i = 0; i < 5000; ++i) {
    (*file)->Put(std::to_string(i) + "\n");
    all += std::to_string(i) + "\n";
  }
  EXPECT_TRUE((*file)->Close());
  EXPECT_EQ(TextOf(folder / "run.log"), all);
}

TEST(RunLogFile, MoreThanFitsIsDroppedAndSaidSo) {
  const test::TempDir folder;
  auto file = RunLogFile::Create(folder / "run.log");
  ASSERT_TRUE(file);
  // Far faster than its thread wakes up.
  for (int i = 0; i < 40'000; ++i) (*file)->Put("line\n");
  EXPECT_TRUE((*file)->Close([] { return std::string("last\n"); }));
  EXPECT_THAT(TextOf(folder / "run.log"), StartsWith("line\nline\n"));
  EXPECT_THAT(TextOf(folder / "run.log"), HasSubstr("# dropped "));
  EXPECT_THAT(TextOf(folder / "run.log"), EndsWith("last\n"));
}

TEST(RunLogFile, ItsEndIsThereAndSaysWhatWasDropped) {
  const test::TempDir folder;
  auto file = RunLogFile::Create(folder / "run.log", 1);
  ASSERT_TRUE(file);
  std::promise<void> goes_on;
  ASSERT_TRUE((*file)->TryPut([&goes_on] {
    goes_on.get_future().wait();
    return std::string("slow\n");
  }));
  for (int i = 0; i < 3; ++i) (*file)->Put("line\n");
  goes_on.set_value();
  EXPECT_TRUE((*file)->Close([] { return std::string("end\n"); }));
  EXPECT_THAT(TextOf(folder / "run.log"), HasSubstr("# dropped "));
  EXPECT_THAT(TextOf(folder / "run.log"), EndsWith("end\n"));
}

TEST(RunLogFile, AFullDiskIsToldAtTheEnd) {
  auto file = RunLogFile::Create("/dev/full");
  if (!file) GTEST_SKIP() << "no /dev/full here";
  (*file)->Put("text\n");
  const auto closed = (*file)->Close();
  ASSERT_FALSE(closed);
  EXPECT_THAT(closed.error().message, HasSubstr("is the disk full?"));
}

TEST(RunLogFile, ALineThatCannotBeMadeIsToldAtTheEnd) {
  const test::TempDir folder;
  auto file = RunLogFile::Create(folder / "run.log");
  ASSERT_TRUE(file);
  EXPECT_TRUE((*file)->TryPut([]() -> std::string { throw std::runtime_error("no memory"); }));
  EXPECT_FALSE((*file)->Close());
}

TEST(RunLogFile, AFolderThatIsNotThereIsNamed) {
  const auto file = RunLogFile::Create("/nowhere/run.log");
  ASSERT_FALSE(file);
  EXPECT_THAT(file.error().message, HasSubstr("/nowhere/run.log"));
}

}  // namespace
}  // namespace trailcast::agent
