#include "agent/diagnosis/run_log_file.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "agent/diagnosis/run_log_reader.h"
#include "agent/diagnosis/src/run_mcap_file.h"
#include "tests/support/await.h"
#include "tests/support/temp_dir.h"
#include "tests/support/walk_frames.h"

namespace trailcast::agent {
namespace {

using testing::ElementsAre;
using testing::Field;
using testing::HasSubstr;

std::string TextOf(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

RunLogFile::Make Text(std::string text) {
  return [text = std::move(text)] { return bag::Bytes(text.begin(), text.end()); };
}

TEST(RunLogFile, WhatWasPutIsOnTheDiskWhileTheRunGoesOn) {
  const test::TempDir folder;
  auto file = RunLogFile::Create(folder / "run", 10);
  ASSERT_TRUE(file) << file.error().message;
  EXPECT_TRUE((*file)->TryPut(Text("first\n")));
  EXPECT_TRUE((*file)->TryPut(Text("second\n")));
  ASSERT_TRUE(test::Await([&] { return TextOf(folder / "run").size() >= 13; }, "both"));
  EXPECT_EQ(TextOf(folder / "run"), "first\nsecond\n") << "not closed yet";
  EXPECT_EQ((*file)->bytes(), 13U);
}

TEST(RunLogFile, ClosedItHoldsAllThatWasPutInOrder) {
  const test::TempDir folder;
  auto file = RunLogFile::Create(folder / "run", 5000);
  ASSERT_TRUE(file);
  std::string all;
  for (int i = 0; i < 5000; ++i) {
    EXPECT_TRUE((*file)->TryPut(Text(std::to_string(i) + "\n")));
    all += std::to_string(i) + "\n";
  }
  EXPECT_TRUE((*file)->Close(Text("last")));
  EXPECT_EQ(TextOf(folder / "run"), all + "last");
}

TEST(RunLogFile, AFullDiskIsToldAtTheEnd) {
  auto file = RunLogFile::Create("/dev/full", 10);
  if (!file) GTEST_SKIP() << "no /dev/full here";
  EXPECT_TRUE((*file)->TryPut(Text("text\n")));
  const auto closed = (*file)->Close();
  ASSERT_FALSE(closed);
  EXPECT_THAT(closed.error().message, HasSubstr("is the disk full?"));
}

TEST(RunLogFile, WhatCannotBeMadeIsToldAtTheEnd) {
  const test::TempDir folder;
  auto file = RunLogFile::Create(folder / "run", 10);
  ASSERT_TRUE(file);
  EXPECT_TRUE((*file)->TryPut([]() -> bag::Bytes { throw std::runtime_error("no memory"); }));
  EXPECT_FALSE((*file)->Close());
}

TEST(RunLogFile, AFolderThatIsNotThereIsNamed) {
  const auto file = RunLogFile::Create("/nowhere/run.mcap", 10);
  ASSERT_FALSE(file);
  EXPECT_THAT(file.error().message, HasSubstr("/nowhere/run.mcap"));
}

// A disk that takes what fits a pipe, and no more before it is told to.
class SlowDisk : public testing::Test {
 protected:
  SlowDisk() {
    EXPECT_EQ(mkfifo((folder_ / "pipe").c_str(), 0600), 0);
    from_ = ::open((folder_ / "pipe").c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    EXPECT_GE(from_, 0);
    (void)::fcntl(from_, F_SETPIPE_SZ, static_cast<int>(kFits));
    auto file = RunMcapFile::Create(folder_ / "pipe", kEveryPicture_s);
    EXPECT_TRUE(file) << file.error().message;
    file_ = std::move(*file);
    (void)::fcntl(from_, F_SETFL, 0);
    EXPECT_TRUE(file_);
    file_->Put({.header = Fields()}, false);
  }
  ~SlowDisk() override {
    if (disk_.joinable()) disk_.join();
    (void)::close(from_);
  }
  void PutFrames(int count, bool patient = false) {
    for (int i = 0; i < count; ++i, ++frames_) {
      FrameRow row;
      row.frame = frames_;
      row.t_s = 0.1 * frames_;
      file_->Put({.stamp = FromSeconds(row.t_s), .row = row, .picture = picture_}, patient);
    }
  }
  void PutMoreThanFits() {
    PutFrames(1);
    // It has begun to write them, and cannot end.
    ASSERT_TRUE(test::Await([this] { return file_->bytes() > kFits; }, "the first frame"));
    PutFrames(kMoreThanFits - 1);
  }
  // Until the file is closed.
  void TakeAll() {
    disk_ = std::thread([this] {
      std::ofstream to(folder_ / "run.mcap", std::ios::binary);
      std::array<char, 4096> bytes{};
      for (ssize_t count = 0; (count = ::read(from_, bytes.data(), bytes.size())) > 0;) {
        to.write(bytes.data(), count);
      }
    });
  }
  Result<RunLog> Close() {
    EXPECT_TRUE(file_->Close({.events = {{.frame = frames_, .what = "end", .text = "there"}}}));
    file_.reset();
    disk_.join();
    return ReadRunLog(folder_ / "run.mcap");
  }

  static constexpr std::uint64_t kFits = 4096;
  static constexpr int kMoreThanFits = 1000;
  test::TempDir folder_;
  image::GrayImage picture_ = test::WalkFrame(0);
  int from_ = -1;
  int frames_ = 0;
  std::unique_ptr<RunMcapFile> file_;
  std::thread disk_;
};

TEST_F(SlowDisk, HoldsUpNobodyAndTheLogSaysWhatItLacksAndHowTheRunEnded) {
  PutMoreThanFits();
  TakeAll();
  const auto log = Close();
  ASSERT_TRUE(log) << log.error().message;
  EXPECT_EQ(log->damaged, 0U);
  EXPECT_GT(log->frames.size(), 100U);
  EXPECT_THAT(log->events,
              ElementsAre(testing::AllOf(
                  Field(&RunEvent::what, "dropped"), Field(&RunEvent::frame, kMoreThanFits),
                  Field(&RunEvent::text, fmt::format("{} frames: writing did not keep up",
                                                     static_cast<std::size_t>(kMoreThanFits) -
                                                         log->frames.size())))));
  ASSERT_TRUE(log->ending);
  EXPECT_EQ(log->ending->text, "there");
}

TEST_F(SlowDisk, ThatTakesMoreAgainTheLogGoesOn) {
  PutMoreThanFits();
  TakeAll();
  PutFrames(1, true);
  PutFrames(100, true);
  const auto log = Close();
  ASSERT_TRUE(log) << log.error().message;
  ASSERT_EQ(log->events.size(), 1U);
  EXPECT_EQ(log->events[0].what, "dropped");
  EXPECT_EQ(log->events[0].frame, kMoreThanFits);
  EXPECT_EQ(log->frames.back().frame, kMoreThanFits + 100);
  EXPECT_EQ(log->frames[log->frames.size() - 101].frame, kMoreThanFits);
  EXPECT_LT(log->frames.size(), static_cast<std::size_t>(kMoreThanFits));
}

TEST_F(SlowDisk, ARecordingWaitsForIt) {
  TakeAll();
  PutFrames(kMoreThanFits, true);
  const auto log = Close();
  ASSERT_TRUE(log) << log.error().message;
  EXPECT_EQ(log->frames.size(), static_cast<std::size_t>(kMoreThanFits));
  EXPECT_TRUE(log->events.empty());
}

}  // namespace
}  // namespace trailcast::agent
