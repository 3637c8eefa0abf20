// Recordings that were cut off, or have bad bytes in them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sched.h>
#include <sys/mount.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <random>

#include "services/bag/bag.h"
#include "tests/support/recorded/bag_writers.h"
#include "tests/support/temp_dir.h"
#include "tests/unit/bag/bag_reading.h"

namespace trailcast::bag {
namespace {

using std::chrono::milliseconds;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr int kMessages = 60;
constexpr const char* kTopic = "/camera";

Bytes MessageNumber(int i) {
  std::mt19937 random(static_cast<unsigned>(i));
  Bytes bytes(700);
  for (auto& byte : bytes) byte = static_cast<std::uint8_t>(random());
  return bytes;
}

void Record(test::BagWriter& writer, int i) {
  writer.Put(kTopic, "sensor_msgs/msg/Image", milliseconds(i), MessageNumber(i));
}

class DamagedBag : public testing::Test {
 protected:
  // Six chunks of ten messages.
  Bytes Mcap(Compression compression) {
    {
      test::McapBagWriter writer(folder_ / "whole.mcap", compression);
      for (int i = 0; i < kMessages; ++i) {
        Record(writer, i);
        if (i % 10 == 9) writer.EndChunk();
      }
    }
    return test::ReadBytes(folder_ / "whole.mcap");
  }
  Bytes Db3() {
    {
      test::Db3Writer writer(folder_ / "whole.db3");
      for (int i = 0; i < kMessages; ++i) Record(writer, i);
    }
    return test::ReadBytes(folder_ / "whole.db3");
  }

  // How many messages are read; each is one that was recorded, none comes twice.
  int CountWhole(const Bytes& file) {
    test::WriteBytes(folder_ / "damaged", file);
    auto bag = Bag::Open(folder_ / "damaged", [](const std::string&) {});
    if (!bag) return -1;
    listed_ = (*bag)->topics().empty() ? 0 : (*bag)->topics().front().messages;
    int last = -1;
    int count = 0;
    for (const Read& read : ReadAll(**bag, kTopic)) {
      const int i = static_cast<int>(read.logged_at / milliseconds(1));
      EXPECT_GT(i, last);
      EXPECT_EQ(read.bytes, MessageNumber(i)) << i;
      last = i;
      ++count;
    }
    damage_ = (*bag)->damage();
    return count;
  }

  test::TempDir folder_;
  std::uint64_t listed_ = 0;  // messages, before they are read
  std::vector<std::string> damage_;
};

// Where the content of the first such record of the list of contents begins.
std::size_t InSummary(const Bytes& file, std::uint8_t opcode) {
  const auto number = [&](std::size_t at) {
    std::size_t value = 0;
    for (std::size_t i = 8; i > 0; --i) value = value << 8U | file.at(at + i - 1);
    return value;
  };
  constexpr std::size_t kFooterContent = 20;
  constexpr std::size_t kMagic = 8;
  constexpr std::size_t kHead = 9;
  std::size_t at = number(file.size() - kMagic - kFooterContent);
  while (file.at(at) != opcode) at += kHead + number(at + 1);
  return at + kHead;
}
constexpr std::uint8_t kChannelRecord = 4;
constexpr std::uint8_t kStatisticsRecord = 11;

TEST_F(DamagedBag, OfAListOfContentsThatLacksASchemaNothingIsBelieved) {
  Bytes file = Mcap(Compression::kLz4);
  file[InSummary(file, kChannelRecord) + 2] += 40;  // the channel's schema, after its own number
  EXPECT_EQ(CountWhole(file), kMessages);
  EXPECT_THAT(damage_, IsEmpty());
}

TEST_F(DamagedBag, OfAListOfContentsThatDoesNotCountAllNothingIsBelieved) {
  const Bytes whole = Mcap(Compression::kLz4);
  const std::size_t statistics = InSummary(whole, kStatisticsRecord);
  // The numbers of all messages and of channels, and the first of the numbers of messages by
  // channel, after its channel: see https://mcap.dev/spec, Statistics.
  for (const std::size_t place : {std::size_t{0}, std::size_t{10}, std::size_t{46 + 2}}) {
    Bytes file = whole;
    ++file[statistics + place];
    EXPECT_EQ(CountWhole(file), kMessages) << place;
    EXPECT_EQ(listed_, kMessages) << place;
    EXPECT_THAT(damage_, IsEmpty()) << place;
  }
}

TEST_F(DamagedBag, ThatAListOfContentsHasMoreThanThereIsIsTold) {
  Bytes file = Mcap(Compression::kLz4);
  const std::size_t statistics = InSummary(file, kStatisticsRecord);
  file[statistics] += 5;
  file[statistics + 46 + 2] += 5;
  EXPECT_EQ(CountWhole(file), kMessages);
  EXPECT_THAT(damage_, ElementsAre(HasSubstr("has 65 messages of /camera, of which 60 are there")));
}

class CutMcap : public DamagedBag, public testing::WithParamInterface<Compression> {};

TEST_P(CutMcap, GivesWhatIsWholeWhereverItWasCut) {
  const Bytes whole = Mcap(GetParam());
  std::mt19937 random(11);
  int before = 0;
  std::vector<std::size_t> cuts(40);
  for (auto& cut : cuts) cut = 8 + random() % (whole.size() - 8);
  std::sort(cuts.begin(), cuts.end());
  for (const std::size_t cut : cuts) {
    SCOPED_TRACE(cut);
    const int count = CountWhole({whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(cut)});
    EXPECT_GE(count, before) << "longer files have more";
    EXPECT_LE(count, kMessages);
    // All but the last chunk: each is about 7 kB, whatever its compression.
    EXPECT_GE(count, 10 * (static_cast<int>(cut) / 9000 - 1));
    before = count;
    if (count < kMessages) {
      EXPECT_THAT(damage_, Contains(HasSubstr("cut off")));
    }
  }
  EXPECT_EQ(CountWhole(whole), kMessages);
  EXPECT_THAT(damage_, IsEmpty());
}
INSTANTIATE_TEST_SUITE_P(All, CutMcap,
                         testing::Values(Compression::kNone, Compression::kLz4,
                                         Compression::kZstd));

TEST_F(DamagedBag, OfAChunkThatIsCutOffTheBeginningIsRead) {
  const Bytes whole = Mcap(Compression::kNone);
  // Within the first chunk's fourth message.
  EXPECT_EQ(CountWhole({whole.begin(), whole.begin() + 2700}), 3);
}

TEST_F(DamagedBag, AChunkWithABadByteIsLeftOutAndTheRestRead) {
  for (const Compression compression : {Compression::kNone, Compression::kLz4}) {
    Bytes file = Mcap(compression);
    file[10'000] ^= 0x10U;  // in the second of six chunks
    EXPECT_EQ(CountWhole(file), kMessages - 10);
    EXPECT_THAT(damage_, Contains(HasSubstr("a damaged chunk, left out")));
  }
}

TEST_F(DamagedBag, LengthsThatLieCostNothing) {
  Bytes file = Mcap(Compression::kZstd);
  // The uncompressed size of the first chunk, after magic and header (9 + 21) and the chunk's own
  // beginning.
  const std::size_t chunk = 8 + 9 + 8 + 4 + 9;
  ASSERT_EQ(file[chunk], 6);
  file[chunk + 9 + 16 + 7] = 0x7F;
  EXPECT_EQ(CountWhole(file), kMessages - 10);
  file = Mcap(Compression::kZstd);
  file[chunk + 1 + 7] = 0x7F;  // the length of its record
  EXPECT_LE(CountWhole(file), 10);
}

TEST_F(DamagedBag, ADb3FileThatWasCutGivesWhatIsWhole) {
  const Bytes whole = Db3();
  EXPECT_EQ(CountWhole(whole), kMessages);
  EXPECT_THAT(damage_, IsEmpty());
  int before = 0;
  for (std::size_t cut = 16'384; cut < whole.size(); cut += 5000) {
    SCOPED_TRACE(cut);
    const int count = CountWhole({whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(cut)});
    EXPECT_GE(count, before);
    before = std::max(before, count);
    if (count >= 0 && count < kMessages) {
      EXPECT_THAT(damage_, Contains(HasSubstr("cut off")));
    }
  }
  EXPECT_GT(before, kMessages / 2);
}

// A recorder that was killed has all in the log, which SQLite does not read without writing beside
// it; a card may be read-only.
TEST_F(DamagedBag, WhatIsInTheLogIsReadAlsoWhereNothingCanBeWritten) {
  const std::filesystem::path card = folder_ / "card";
  std::filesystem::create_directory(card);
  {
    SQLite::Database db((folder_ / "run.db3").string(),
                        SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
    db.exec("PRAGMA journal_mode = WAL");
    test::Db3Writer::MakeTables(db);
    db.exec("INSERT INTO topics VALUES(1, '/camera', 'sensor_msgs/msg/Image', 'cdr', '')");
    db.exec("INSERT INTO messages VALUES(1, 1, 5, x'0001')");
    for (const char* file : {"run.db3", "run.db3-wal"}) {
      std::filesystem::copy_file(folder_ / file, card / file);
    }
  }
  ASSERT_GT(std::filesystem::file_size(card / "run.db3-wal"), 0U);
  constexpr int kCannot = 77;
  const auto read_there = [&] {
    if (unshare(CLONE_NEWNS) != 0 ||
        mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) != 0 ||
        mount(card.c_str(), card.c_str(), nullptr, MS_BIND, nullptr) != 0 ||
        mount("none", card.c_str(), nullptr, MS_REMOUNT | MS_BIND | MS_RDONLY, nullptr) != 0) {
      return kCannot;
    }
    const auto bag = OpenBag(card / "run.db3");
    return bag && ReadAll(*bag, kTopic).size() == 1 && bag->damage().empty() ? 0 : 1;
  };
  const pid_t child = fork();
  if (child == 0) std::_Exit(read_there());
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFEXITED(status));
  if (WEXITSTATUS(status) == kCannot) GTEST_SKIP() << "mounts cannot be staged here";
  EXPECT_EQ(WEXITSTATUS(status), 0);
}

TEST_F(DamagedBag, ADb3FileWithABadPageGivesTheRest) {
  Bytes file = Db3();
  std::fill_n(file.begin() + 6 * 4096, 4096, 0xEE);
  const int count = CountWhole(file);
  EXPECT_GT(count, kMessages / 2);
  EXPECT_LT(count, kMessages);
  EXPECT_THAT(damage_, Contains(HasSubstr("damaged")));
}

TEST_F(DamagedBag, ACompressedFileThatBreaksOffGivesItsBeginning) {
  constexpr int kMany = 600;  // four blocks of zstd's
  {
    test::McapBagWriter writer(folder_ / "whole.mcap", Compression::kNone);
    for (int i = 0; i < kMany; ++i) Record(writer, i);
  }
  Bytes packed = Compress(Compression::kZstd, test::ReadBytes(folder_ / "whole.mcap"));
  EXPECT_EQ(CountWhole(packed), kMany);
  packed.erase(packed.end() - 20, packed.end());
  const int count = CountWhole(packed);
  EXPECT_GT(count, kMany / 2);
  EXPECT_LT(count, kMany);
  EXPECT_THAT(damage_, Contains(HasSubstr("its compression breaks off")));
}

TEST_F(DamagedBag, TheSameDamageIsToldOnce) {
  Bytes file = Mcap(Compression::kLz4);
  file[10'000] ^= 0x10U;
  test::WriteBytes(folder_ / "damaged", file);
  const auto bag = OpenBag(folder_ / "damaged");
  ASSERT_TRUE(bag);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(ReadAll(*bag, kTopic).size(), 50U);
  EXPECT_EQ(bag->damage().size(), 1U);
}

}  // namespace
}  // namespace trailcast::bag
