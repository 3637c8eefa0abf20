#include "services/bag/bag.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "services/bag/ros_messages.h"
#include "tests/support/places.h"
#include "tests/support/recorded/bag_writers.h"
#include "tests/support/recorded/ros_messages.h"
#include "tests/support/temp_dir.h"
#include "tests/unit/bag/bag_reading.h"

namespace trailcast::bag {
namespace {

namespace fs = std::filesystem;
using std::chrono::milliseconds;
using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr const char* kOdom = "nav_msgs/msg/Odometry";

// `count` messages of one byte or so on /odom, one of another topic between them.
void Record(test::BagWriter& writer, int first, int count) {
  for (int i = first; i < first + count; ++i) {
    writer.Put("/odom", kOdom, milliseconds(10 * i), Bytes(20, static_cast<std::uint8_t>(i)));
    writer.Put("/scan", "sensor_msgs/msg/LaserScan", milliseconds(10 * i), Bytes(5000, 1));
  }
}

void ExpectRecorded(Bag& bag, int count) {
  const auto read = ReadAll(bag, "/odom");
  ASSERT_EQ(read.size(), static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    const Read expected{milliseconds(10 * i), Bytes(20, static_cast<std::uint8_t>(i))};
    EXPECT_EQ(read[static_cast<std::size_t>(i)], expected) << i;
  }
  EXPECT_THAT(bag.damage(), IsEmpty());
}

TEST(Bag, GivesOneTopicsMessagesAsOftenAsWanted) {
  const test::TempDir folder;
  { Record(*std::make_unique<test::Db3Writer>(folder / "a.db3"), 0, 30); }
  const auto bag = OpenBag(folder / "a.db3");
  ASSERT_TRUE(bag);
  ASSERT_EQ(bag->topics().size(), 2U);
  EXPECT_EQ(bag->topics()[0].name, "/odom");
  EXPECT_EQ(bag->topics()[0].type, kOdom);
  EXPECT_EQ(bag->topics()[0].encoding, "cdr");
  EXPECT_EQ(bag->topics()[0].messages, 30U);
  EXPECT_EQ(ReadAll(*bag, "/scan").size(), 30U);
  ExpectRecorded(*bag, 30);
  ExpectRecorded(*bag, 30);
}

TEST(Bag, FarMoreThanAFileIsLargeIsNotUnpackedOfOneThatIsBounded) {
  const test::TempDir folder;
  const fs::path file = folder / "bomb.mcap";
  constexpr std::uint64_t kGrowth = 2;
  constexpr std::size_t kMessage = std::size_t{1} << 20U;
  constexpr std::size_t kMessages = 100;
  {
    test::McapBagWriter writer(file, Compression::kZstd);
    for (std::size_t i = 0; i < kMessages; ++i) {
      writer.Put("/odom", kOdom, milliseconds(i), Bytes(kMessage, 0));
    }
  }
  const auto bag = Bag::Open(
      file, [](const std::string&) {}, kGrowth);
  ASSERT_TRUE(bag);
  for (int i = 0; i < 2; ++i) {  // each time it is read
    const std::size_t bytes = ReadAll(**bag, "/odom").size() * kMessage;
    EXPECT_LE(bytes, Bag::kFreeBytes + kGrowth * fs::file_size(file));
    EXPECT_GT(bytes, Bag::kFreeBytes / 2);
  }
  EXPECT_THAT((*bag)->damage().front(), HasSubstr("far too much"));
  EXPECT_EQ(ReadAll(*OpenBag(file), "/odom").size(), kMessages);
}

class McapCompressions : public testing::TestWithParam<Compression> {};

TEST_P(McapCompressions, AreRead) {
  const test::TempDir folder;
  {
    test::McapBagWriter writer(folder / "a.mcap", GetParam());
    Record(writer, 0, 10);
    writer.EndChunk();
    Record(writer, 10, 20);
  }
  const auto bag = OpenBag(folder / "a.mcap");
  ASSERT_TRUE(bag);
  ASSERT_EQ(bag->topics().size(), 2U);
  EXPECT_EQ(bag->topics()[1].messages, 30U);
  ExpectRecorded(*bag, 30);
}
INSTANTIATE_TEST_SUITE_P(All, McapCompressions,
                         testing::Values(Compression::kNone, Compression::kLz4,
                                         Compression::kZstd));

// Files of another implementation of MCAP: in chunks of either compression, and without chunks or a
// list of contents.
TEST(Bag, ReadsWhatOtherProgramsWrote) {
  for (const char* name : {"lz4.mcap", "zstd.mcap", "loose.mcap"}) {
    SCOPED_TRACE(name);
    const auto bag = OpenBag(fs::path(SourceDir()) / "tests/unit/bag/others" / name);
    ASSERT_TRUE(bag);
    ASSERT_EQ(bag->topics().size(), 2U);
    EXPECT_EQ(bag->topics()[0].type, "sensor_msgs/msg/Image");
    EXPECT_EQ(bag->topics()[0].messages, 10U);
    const auto pictures = ReadAll(*bag, "/camera/image_raw");
    ASSERT_EQ(pictures.size(), 10U);
    for (unsigned i = 0; i < 10; ++i) {
      const auto image = ReadImage(pictures[i].bytes);
      ASSERT_TRUE(image) << image.error().message;
      EXPECT_EQ(image->stamp, std::chrono::seconds(1'700'000'000) + milliseconds(100 * i));
      EXPECT_EQ(pictures[i].logged_at, image->stamp + milliseconds(5));
      EXPECT_EQ(image->picture.width_px, 8U);
      EXPECT_EQ(image->picture.height_px, 6U);
      EXPECT_EQ(image->picture.bytes[3], 15 + i);
    }
    const auto odometry = ReadAll(*bag, "/odom");
    ASSERT_EQ(odometry.size(), 10U);
    const auto last = ReadOdometry(odometry.back().bytes);
    ASSERT_TRUE(last);
    EXPECT_NEAR(last->pose.y_m, -1.8, 1e-12);
    EXPECT_NEAR(last->pose.heading_rad, 0.09, 1e-12);
    EXPECT_THAT(bag->damage(), IsEmpty());
  }
}

// As metadata.yaml lists them, one of them and not the other unpacked by a player.
TEST(Bag, ReadsAFolderOfSeveralFilesInTheOrderOfTheirTimes) {
  const test::TempDir folder;
  const auto file = [&](const char* name) { return folder / name; };
  { Record(*std::make_unique<test::Db3Writer>(file("run_0.db3")), 0, 10); }
  { Record(*std::make_unique<test::Db3Writer>(file("run_1.db3")), 10, 10); }
  { Record(*std::make_unique<test::Db3Writer>(file("run_10.db3")), 20, 10); }
  { Record(*std::make_unique<test::Db3Writer>(file("of another run.db3")), 90, 10); }
  test::WriteBytes(file("run_1.db3.zstd"),
                   Compress(Compression::kZstd, test::ReadBytes(file("run_1.db3"))));
  fs::remove(file("run_1.db3"));
  std::ofstream(file("metadata.yaml")) << "rosbag2_bagfile_information:\n  version: 4\n"
                                          "  relative_file_paths:\n    - \"run_10.db3\"\n"
                                          "    - run/run_0.db3.zstd\n    - run_1.db3.zstd\n"
                                          "  duration:\n    nanoseconds: 1\n";
  const auto bag = OpenBag(folder.path());
  ASSERT_TRUE(bag);
  EXPECT_EQ(bag->topics()[0].messages, 30U);
  EXPECT_EQ(ReadAll(*bag, "/odom").size(), 30U);
  EXPECT_THAT(bag->damage(),
              ElementsAre(AllOf(HasSubstr("of another run.db3"), HasSubstr("left out"))));
}

// Metadata is written when a recording ends; the recorder that crashed wrote none of what came
// after.
TEST(Bag, FilesOfARecordingThatItsMetadataDoesNotListAreRead) {
  const test::TempDir folder;
  { Record(*std::make_unique<test::Db3Writer>(folder / "run_0.db3"), 0, 10); }
  {
    test::McapBagWriter writer(folder / "run_1.mcap", Compression::kLz4);
    Record(writer, 10, 10);
  }
  std::ofstream(folder / "._run_1.mcap") << "Mac OS X";
  std::ofstream(folder / "metadata.yaml") << "  relative_file_paths:\n    - run_0.db3\n";
  const auto bag = OpenBag(folder.path());
  ASSERT_TRUE(bag);
  EXPECT_EQ(ReadAll(*bag, "/odom").size(), 20U);
  EXPECT_THAT(bag->damage(), ElementsAre(AllOf(HasSubstr("run_1.mcap"), HasSubstr("but read"))));
}

TEST(Bag, FilesThatWereRenamedAreReadByTheirNewNames) {
  const test::TempDir folder;
  { Record(*std::make_unique<test::Db3Writer>(folder / "lap1.db3"), 0, 10); }
  std::ofstream(folder / "metadata.yaml") << "  relative_file_paths:\n    - run_0.db3\n";
  const auto bag = OpenBag(folder.path());
  ASSERT_TRUE(bag);
  EXPECT_EQ(ReadAll(*bag, "/odom").size(), 10U);
  EXPECT_THAT(bag->damage(), ElementsAre(HasSubstr("run_0.db3"), HasSubstr("lap1.db3")));
}

TEST(Bag, ThatMetadataCountsMoreThanThereIsIsTold) {
  const test::TempDir folder;
  { Record(*std::make_unique<test::Db3Writer>(folder / "run_0.db3"), 0, 10); }
  const auto damage_where = [&](int messages) {
    std::ofstream(folder / "metadata.yaml")
        << "  relative_file_paths:\n    - run_0.db3\n  message_count: " << messages
        << "\n  topics_with_message_count:\n    - topic_metadata:\n      message_count: 900\n";
    return OpenBag(folder.path())->damage();
  };
  EXPECT_THAT(damage_where(20), IsEmpty());
  EXPECT_THAT(damage_where(21), ElementsAre(HasSubstr("counts 21 messages, of which 20")));
}

TEST(Bag, AFileOfSeveralThatIsNoRecordingIsLeftOutAndTold) {
  const test::TempDir folder;
  { Record(*std::make_unique<test::Db3Writer>(folder / "run_0.db3"), 0, 10); }
  std::ofstream(folder / "run_1.db3") << "";
  const auto bag = OpenBag(folder.path());
  ASSERT_TRUE(bag);
  EXPECT_EQ(ReadAll(*bag, "/odom").size(), 10U);
  EXPECT_THAT(bag->damage(), ElementsAre(HasSubstr("run_1.db3 is no recording")));
  std::filesystem::remove(folder / "run_0.db3");
  std::ofstream(folder / "run_2.db3") << "";
  EXPECT_THAT(ErrorOf(folder.path()), AllOf(HasSubstr("run_1.db3"), HasSubstr("run_2.db3")));
}

TEST(Bag, AFolderWhoseRecorderCrashedHasNoMetadata) {
  const test::TempDir folder;
  { Record(*std::make_unique<test::Db3Writer>(folder / "run_1.db3"), 5, 5); }
  {
    test::McapBagWriter writer(folder / "run_0.mcap", Compression::kZstd);
    Record(writer, 0, 5);
  }
  const auto bag = OpenBag(folder.path());
  ASSERT_TRUE(bag);
  ExpectRecorded(*bag, 10);
}

TEST(Bag, APartThatIsMissingIsToldAlsoWithoutMetadata) {
  const test::TempDir folder;
  { Record(*std::make_unique<test::Db3Writer>(folder / "run_0.db3"), 0, 5); }
  { Record(*std::make_unique<test::Db3Writer>(folder / "run_2.db3"), 10, 5); }
  { Record(*std::make_unique<test::Db3Writer>(folder / "run_20261130.db3"), 20, 5); }
  const auto damage = [&] { return OpenBag(folder.path())->damage(); };
  const auto gap =
      AllOf(HasSubstr("run_1: not there"), HasSubstr("run_0.db3"), HasSubstr("run_2.db3"));
  EXPECT_THAT(damage(), ElementsAre(gap));
  EXPECT_EQ(ReadAll(*OpenBag(folder.path()), "/odom").size(), 15U);
  std::ofstream(folder / "metadata.yaml") << "  relative_file_paths:\n    - run_0.db3\n";
  EXPECT_THAT(damage(), Contains(gap)) << "its recorder ended before it listed all";
}

TEST(Bag, MessagesMayBeCompressedOneByOne) {
  const test::TempDir folder;
  { Record(*std::make_unique<test::Db3Writer>(folder / "a.db3", true), 0, 10); }
  const auto bag = OpenBag(folder / "a.db3");
  ASSERT_TRUE(bag);
  ExpectRecorded(*bag, 10);
}

TEST(Bag, AFileThatIsListedAndNotThereIsTold) {
  const test::TempDir folder;
  { Record(*std::make_unique<test::Db3Writer>(folder / "run_0.db3"), 0, 5); }
  std::ofstream(folder / "metadata.yaml")
      << "  relative_file_paths:\n    - run_0.db3\n    - run_1.db3\n";
  const auto bag = OpenBag(folder.path());
  ASSERT_TRUE(bag);
  EXPECT_THAT(bag->damage(), ElementsAre(AllOf(HasSubstr("run_1.db3"), HasSubstr("not there"))));
}

TEST(Bag, WhatIsNoRecordingIsToldApart) {
  const test::TempDir folder;
  EXPECT_THAT(ErrorOf(folder / "none.db3"), HasSubstr("no recording at"));
  EXPECT_THAT(ErrorOf(folder.path()), HasSubstr("ending in .db3 or .mcap"));
  std::ofstream(folder / "text.mcap") << "a text of some length";
  EXPECT_THAT(ErrorOf(folder / "text.mcap"), HasSubstr("no recording that is understood"));
  std::ofstream(folder / "old.bag") << "#ROSBAG V2.0\n";
  EXPECT_THAT(ErrorOf(folder / "old.bag"), HasSubstr("ROS 1"));
  { SQLite::Database(folder / "other.db3", 6).exec("CREATE TABLE topics(id INTEGER)"); }
  EXPECT_THAT(ErrorOf(folder / "other.db3"), HasSubstr("no tables"));
}

}  // namespace
}  // namespace trailcast::bag
