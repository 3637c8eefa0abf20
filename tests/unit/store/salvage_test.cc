#include "services/store/salvage.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sqlite3.h>

#include <fstream>
#include <iterator>

#include "services/store/lacking.h"
#include "services/store/route_store.h"
#include "tests/support/temp_dir.h"
#include "tests/unit/store/pieces.h"

namespace trailcast::store {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr std::uint32_t kSegments = 40;
constexpr std::size_t kPage = 4096;

class SalvageTest : public testing::Test {
 protected:
  void SetUp() override {
    const auto store = OpenSqliteStore(file_).value();
    for (std::uint32_t i = 0; i < kSegments; ++i) {
      ASSERT_TRUE(store->AppendSegments(Pieces({i})));
    }
    ASSERT_TRUE(store->PutRoute(Complete(kSegments)));
    ASSERT_TRUE(store->MarkReceipted(kYard, Indices({0, 39})));
  }
  [[nodiscard]] std::string Read() const {
    std::ifstream in(file_, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  }
  // The number of a table's or an index' first page.
  [[nodiscard]] std::size_t Root(const std::string& of) const {
    sqlite3* db = nullptr;
    EXPECT_EQ(sqlite3_open(file_.c_str(), &db), SQLITE_OK);
    std::size_t root = 0;
    const auto note = [](void* into, int, char** values, char**) {
      *static_cast<std::size_t*>(into) = std::stoul(values[0]);
      return 0;
    };
    const std::string sql = "SELECT rootpage FROM sqlite_schema WHERE name = '" + of + "'";
    EXPECT_EQ(sqlite3_exec(db, sql.c_str(), note, &root, nullptr), SQLITE_OK);
    sqlite3_close(db);
    return root;
  }
  void Write(const std::string& bytes) const { std::ofstream(file_, std::ios::binary) << bytes; }

  test::TempDir dir_;
  const std::filesystem::path file_ = dir_ / "routes.db";
  const std::filesystem::path saved_ = dir_ / "saved.db";
};

TEST_F(SalvageTest, OfAWholeStoreNothingIsLost) {
  const std::string before = Read();
  const auto salvaged = Salvage(file_, saved_);
  ASSERT_TRUE(salvaged) << salvaged.error().message;
  EXPECT_EQ(salvaged->routes, 1U);
  EXPECT_EQ(salvaged->segments, kSegments);
  EXPECT_THAT(salvaged->lost, IsEmpty());
  EXPECT_EQ(Read(), before);
  const auto saved = OpenSqliteStore(saved_).value();
  EXPECT_EQ(saved->FindRoute(kYard).value(), Complete(kSegments));
  EXPECT_EQ(saved->UnreceiptedSegments(kYard).value().size(), kSegments - 2);
  EXPECT_THAT(saved->Verify().value(), IsEmpty());
}

TEST_F(SalvageTest, AFlippedByteCostsTheSegmentItIsIn) {
  std::string bytes = Read();
  const route::SegmentPiece piece = Piece(7);
  const std::size_t at =
      bytes.find(std::string(piece.bytes.begin() + 200, piece.bytes.begin() + 240));
  ASSERT_NE(at, std::string::npos);
  bytes[at] ^= 1;
  Write(bytes);
  const auto salvaged = Salvage(file_, saved_);
  ASSERT_TRUE(salvaged) << salvaged.error().message;
  EXPECT_EQ(salvaged->segments, kSegments - 1);
  EXPECT_THAT(salvaged->lost, ElementsAre(HasSubstr("segment 7 of route 'yard'")));
  EXPECT_EQ(OpenSqliteStore(saved_).value()->HeldSegments(kYard).value().size(), kSegments - 1);
}

// A sector of the disk is lost: a page's beginning is what makes it a page.
TEST_F(SalvageTest, SixtyFourLostBytesCostAFewSegmentsAndEachIsNamed) {
  const std::string whole = Read();
  std::size_t harmless = 0;
  std::size_t costly = 0;
  for (std::size_t page = 0; page * kPage < whole.size(); ++page) {
    std::string bytes = whole;
    std::fill_n(bytes.begin() + static_cast<std::ptrdiff_t>(page * kPage), 64, '\x5A');
    Write(bytes);
    const auto salvaged = Salvage(file_, saved_);
    ASSERT_TRUE(salvaged) << "page " << page << ": " << salvaged.error().message;
    EXPECT_GE(salvaged->segments, kSegments - 8) << "page " << page;
    // The file's own header is not needed.
    EXPECT_EQ(salvaged->lost.empty(), page == 0) << "page " << page;
    const auto saved = OpenSqliteStore(saved_).value();
    EXPECT_THAT(saved->Verify().value(), IsEmpty());
    const auto lacking = FindLacking(*saved).value();
    if (salvaged->routes == 0) {
      EXPECT_THAT(salvaged->lost, Contains(HasSubstr("what is known of teaching 1")));
      EXPECT_EQ(salvaged->segments, kSegments);
    } else if (salvaged->segments < kSegments) {
      ASSERT_EQ(lacking.size(), 1U) << "page " << page;
      EXPECT_EQ(lacking[0].segments.size() + salvaged->segments, kSegments);
      EXPECT_THAT(salvaged->lost, Contains(Describe(lacking[0])));
    }
    ++(salvaged->segments < kSegments || salvaged->routes == 0 ? costly : harmless);
    std::filesystem::remove(saved_);
  }
  EXPECT_GE(harmless, 5U) << "roots and indices cost nothing";
  EXPECT_GE(costly, kSegments) << "hardly any page held a segment: nothing was tested";
}

TEST_F(SalvageTest, WithoutTheRootsOfItsTablesAndTheFilesHeaderEverythingIsSaved) {
  std::string bytes = Read();
  for (const char* of : {"segment", "segment_by_digest"}) {
    std::fill_n(bytes.begin() + static_cast<std::ptrdiff_t>((Root(of) - 1) * kPage), kPage, '\0');
  }
  std::fill_n(bytes.begin(), kPage, '\0');
  Write(bytes);
  const auto salvaged = Salvage(file_, saved_);
  ASSERT_TRUE(salvaged) << salvaged.error().message;
  EXPECT_EQ(salvaged->segments, kSegments);
  EXPECT_THAT(salvaged->lost, ElementsAre(HasSubstr("3 of the file's")));
  const auto saved = OpenSqliteStore(saved_).value();
  EXPECT_EQ(saved->FindRoute(kYard).value(), Complete(kSegments));
  EXPECT_EQ(saved->UnreceiptedSegments(kYard).value().size(), kSegments - 2);
}

TEST_F(SalvageTest, ARowWhoseNumberIsDamagedIsSaved) {
  const std::string whole = Read();
  std::size_t damaged = 0;
  for (std::size_t page = kPage; page < whole.size(); page += kPage) {
    // https://www.sqlite.org/fileformat.html: a leaf of a table; its first cell holds two bytes of
    // length and then the row's number.
    const auto byte = [&](std::size_t at) { return static_cast<std::uint8_t>(whole[page + at]); };
    const std::size_t cell = byte(8) * 256U + byte(9);
    if (byte(0) != 0x0D || whole.find(kYard.route.value(), page + cell) > page + cell + 40)
      continue;
    if (byte(cell) < 0x80 || byte(cell + 2) <= 1) continue;
    std::string bytes = whole;
    bytes[page + cell + 2] = 1;
    Write(bytes);
    const auto salvaged = Salvage(file_, saved_);
    ASSERT_TRUE(salvaged) << salvaged.error().message;
    EXPECT_EQ(salvaged->segments, kSegments) << "page at " << page;
    EXPECT_THAT(OpenSqliteStore(saved_).value()->Verify().value(), IsEmpty());
    std::filesystem::remove(saved_);
    ++damaged;
  }
  EXPECT_GT(damaged, 3U);
}

TEST_F(SalvageTest, AStoreCutShortKeepsWhatIsLeft) {
  const std::string whole = Read();
  Write(whole.substr(0, whole.size() * 2 / 3));
  ASSERT_FALSE(OpenSqliteStore(file_));
  const auto salvaged = Salvage(file_, saved_);
  ASSERT_TRUE(salvaged) << salvaged.error().message;
  EXPECT_GE(salvaged->segments, kSegments / 2);
  EXPECT_LT(salvaged->segments, kSegments);
  EXPECT_THAT(OpenSqliteStore(saved_).value()->Verify().value(), IsEmpty());
}

TEST_F(SalvageTest, WhatWasDeletedStaysDeleted) {
  const route::RouteKey gone{RouteId(std::string(32, '9')), TeachingId(1)};
  {
    const auto store = OpenSqliteStore(file_).value();
    route::RouteInfo tombstone = Complete(1);
    tombstone.key = gone;
    tombstone.standing = route::Standing::kDeleted;
    tombstone.edition = 1;
    ASSERT_TRUE(store->PutRoute(tombstone));
  }
  ASSERT_TRUE(Salvage(file_, saved_));
  const auto saved = OpenSqliteStore(saved_).value();
  EXPECT_EQ(saved->FindRoute(gone).value()->standing, route::Standing::kDeleted);
}

TEST_F(SalvageTest, SegmentsThatRelyOnOthersBytesAreSavedWithThem) {
  route::SegmentPiece again = Piece(3);
  again.key.teaching = TeachingId(2);
  {
    const auto store = OpenSqliteStore(file_).value();
    ASSERT_TRUE(store->AppendSegments({&again, 1}));
  }
  const auto salvaged = Salvage(file_, saved_);
  ASSERT_TRUE(salvaged) << salvaged.error().message;
  EXPECT_EQ(salvaged->segments, kSegments + 1);
  const auto saved = OpenSqliteStore(saved_).value();
  EXPECT_EQ(saved->ReadSegment(again.key, again.index).value(), again);
}

TEST_F(SalvageTest, BytesOfARowThatDoesNotSayAnyMoreWhoseTheyAreAreFoundByTheirDigest) {
  route::SegmentPiece again = Piece(3);
  again.key.teaching = TeachingId(2);
  ASSERT_TRUE(OpenSqliteStore(file_).value()->AppendSegments({&again, 1}));
  std::string bytes = Read();
  // The route's id, in the row that has the bytes.
  const std::size_t content =
      bytes.find(std::string(again.bytes.begin(), again.bytes.begin() + 40));
  ASSERT_NE(content, std::string::npos);
  const std::size_t id = bytes.rfind(kYard.route.value(), content);
  ASSERT_LT(content - id, 120U);
  std::fill_n(bytes.begin() + static_cast<std::ptrdiff_t>(id), 8, '#');
  Write(bytes);
  const auto salvaged = Salvage(file_, saved_);
  ASSERT_TRUE(salvaged) << salvaged.error().message;
  EXPECT_EQ(salvaged->segments, kSegments);
  EXPECT_THAT(salvaged->lost, Contains(HasSubstr("segment 3 of route 'yard'")));
  EXPECT_EQ(OpenSqliteStore(saved_).value()->ReadSegment(again.key, again.index).value(), again);
}

TEST_F(SalvageTest, WhatTheLogHasIsSavedAlthoughTheLogIsDamagedToo) {
  const std::filesystem::path other = dir_ / "other.db";
  {
    const auto store = OpenSqliteStore(other).value();
    ASSERT_TRUE(store->PutRoute(Complete(kSegments)));
    for (std::uint32_t i = 0; i < kSegments; ++i) ASSERT_TRUE(store->AppendSegments(Pieces({i})));
    for (const char* part : {"", "-wal"}) {
      std::filesystem::copy_file(other.string() + part, file_.string() + part,
                                 std::filesystem::copy_options::overwrite_existing);
    }
  }
  ASSERT_GT(std::filesystem::file_size(file_.string() + "-wal"), kSegments * kPage);
  Write("");  // what was in the file has to come from the log
  std::fstream log(file_.string() + "-wal", std::ios::in | std::ios::out | std::ios::binary);
  log.write(std::string(32, '#').data(), 32);
  log.close();
  const auto salvaged = Salvage(file_, saved_);
  ASSERT_TRUE(salvaged) << salvaged.error().message;
  EXPECT_EQ(salvaged->segments, kSegments);
  EXPECT_EQ(salvaged->routes, 1U);
}

TEST_F(SalvageTest, WithItsLogAWholeStoreLosesNothing) {
  const auto store = OpenSqliteStore(dir_ / "other.db").value();
  for (std::uint32_t i = 0; i < kSegments; ++i) ASSERT_TRUE(store->AppendSegments(Pieces({i})));
  ASSERT_TRUE(store->PutRoute(Complete(kSegments)));
  for (const char* part : {"", "-wal"}) {
    std::filesystem::copy_file((dir_ / "other.db").string() + part, file_.string() + part,
                               std::filesystem::copy_options::overwrite_existing);
  }
  const auto salvaged = Salvage(file_, saved_);
  ASSERT_TRUE(salvaged) << salvaged.error().message;
  EXPECT_EQ(salvaged->segments, kSegments);
  EXPECT_THAT(salvaged->lost, IsEmpty());
}

// Its rows have other columns: were nothing found in it a store without routes, a repair would put
// that in its place.
TEST_F(SalvageTest, AStoreOfAnotherVersionIsRefusedAndStaysAsItIs) {
  sqlite3* db = nullptr;
  ASSERT_EQ(sqlite3_open(file_.c_str(), &db), SQLITE_OK);
  EXPECT_EQ(sqlite3_exec(db,
                         "CREATE TABLE other AS SELECT route, teaching, number, 1, digest, seal, "
                         "bytes FROM segment; DROP TABLE segment; DROP TABLE route; "
                         "PRAGMA user_version = 5; VACUUM",
                         nullptr, nullptr, nullptr),
            SQLITE_OK)
      << sqlite3_errmsg(db);
  sqlite3_close(db);
  const std::string before = Read();
  const auto repaired = Repair(file_);
  ASSERT_FALSE(repaired);
  EXPECT_EQ(repaired.error().code, ErrorCode::kCorrupt);
  EXPECT_THAT(repaired.error().message, HasSubstr("nothing of a route store of version 7"));
  EXPECT_EQ(Read(), before);
}

TEST_F(SalvageTest, WithoutRoomForItNothingIsMade) {
  const auto salvaged = Salvage(file_, saved_, {.max_bytes = 120'000});
  ASSERT_FALSE(salvaged);
  EXPECT_EQ(salvaged.error().code, ErrorCode::kUnavailable);
  EXPECT_FALSE(std::filesystem::exists(saved_));
  EXPECT_THAT(OpenSqliteStore(file_).value()->Verify().value(), IsEmpty());
}

TEST_F(SalvageTest, WhatIsNoStoreOrInUseIsRefused) {
  {
    const auto in_use = OpenSqliteStore(file_).value();
    const auto salvaged = Salvage(file_, saved_);
    ASSERT_FALSE(salvaged);
    EXPECT_EQ(salvaged.error().code, ErrorCode::kConflict);
  }
  Write("Buy milk.\n");
  const auto salvaged = Salvage(file_, saved_);
  ASSERT_FALSE(salvaged);
  EXPECT_EQ(salvaged.error().code, ErrorCode::kCorrupt);
  EXPECT_FALSE(std::filesystem::exists(saved_));
  EXPECT_FALSE(Salvage(dir_ / "nowhere.db", saved_));
  Write("");
  EXPECT_FALSE(Salvage(file_, file_));
}

}  // namespace
}  // namespace trailcast::store
