#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>

#include "services/store/route_store.h"
#include "tests/support/temp_dir.h"
#include "tests/unit/store/pieces.h"

namespace trailcast::store {
namespace {

using testing::HasSubstr;

constexpr std::uint64_t kKiB = 1024;

// Appends until the store refuses; returns how many segments it took, and the refusal.
std::pair<std::uint32_t, Error> Fill(RouteStore& store, std::uint32_t from = 0) {
  for (std::uint32_t i = from; i < 10000; ++i) {
    const Result<void> appended = store.AppendSegments(Pieces({i}));
    if (!appended) return {i, appended.error()};
  }
  return {10000, {}};
}

void ExpectHoldsExactly(RouteStore& store, std::uint32_t count) {
  ASSERT_EQ(store.HeldSegments(kYard).value().size(), count);
  for (std::uint32_t i = 0; i < count; ++i) {
    ASSERT_EQ(store.ReadSegment(kYard, SegmentIndex(i)).value(), Piece(i));
  }
  EXPECT_TRUE(store.Verify().value().empty());
}

TEST(StoreQuota, FullStoreRefusesMoreKeepsWhatItHasAndGoesOnWhenTheLimitIsRaised) {
  test::TempDir dir;
  std::uint32_t taken = 0;
  {
    auto store = OpenSqliteStore(dir / "routes.db", {.max_bytes = 256 * kKiB}).value();
    const auto [count, error] = Fill(*store);
    taken = count;
    EXPECT_EQ(error.code, ErrorCode::kUnavailable);
    EXPECT_THAT(error.message, HasSubstr("free disk space or raise the store's limit"));
    EXPECT_GT(taken, 20U);
    EXPECT_LT(taken, 52U) << "256 KiB of 5000-byte segments";
    ExpectHoldsExactly(*store, taken);
  }
  EXPECT_LE(std::filesystem::file_size(dir / "routes.db"), 256 * kKiB);
  auto store = OpenSqliteStore(dir / "routes.db", {.max_bytes = 1024 * kKiB}).value();
  EXPECT_TRUE(store->AppendSegments(Pieces({taken})));
  ExpectHoldsExactly(*store, taken + 1);
}

TEST(StoreQuota, BatchThatDoesNotFitIsRefusedWhole) {
  test::TempDir dir;
  auto store = OpenSqliteStore(dir / "routes.db", {.max_bytes = 128 * kKiB}).value();
  std::vector<route::SegmentPiece> batch;
  for (std::uint32_t i = 0; i < 40; ++i) batch.push_back(Piece(i));
  const Result<void> appended = store->AppendSegments(batch);
  ASSERT_FALSE(appended);
  EXPECT_EQ(appended.error().code, ErrorCode::kUnavailable);
  ExpectHoldsExactly(*store, 0);
}

TEST(StoreQuota, ARevisionCostsWhatIsNewInIt) {
  test::TempDir dir;
  auto store = OpenSqliteStore(dir / "routes.db", {.max_bytes = 256 * kKiB}).value();
  const std::uint32_t taken = Fill(*store).first;
  ASSERT_GT(taken, 20U);
  const route::SegmentPiece again = [] {
    route::SegmentPiece piece = Piece(0);
    piece.key.teaching = TeachingId(2);
    return piece;
  }();
  EXPECT_TRUE(store->AppendSegments({&again, 1})) << "its bytes are there";
  route::SegmentPiece other = Piece(0, 1);
  other.key = again.key;
  other.index = SegmentIndex(1);
  EXPECT_FALSE(store->AppendSegments({&other, 1}));
}

// The nearest thing to a full disk that a process can stage: the kernel refuses to let files grow.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) {
    handler_ = signal(SIGXFSZ, SIG_IGN);
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    setrlimit(RLIMIT_FSIZE, &before_);
    signal(SIGXFSZ, handler_);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;

 private:
  rlimit before_{};
  void (*handler_)(int) = nullptr;
};

TEST(StoreQuota, WriteThatTheKernelRefusesIsUnavailableAndTheStoreGoesOnAfterwards) {
  test::TempDir dir;
  auto store = OpenSqliteStore(dir / "routes.db").value();
  std::uint32_t taken = 0;
  {
    const FileSizeLimit limit(200 * kKiB);
    const auto [count, error] = Fill(*store);
    taken = count;
    EXPECT_EQ(error.code, ErrorCode::kUnavailable);
    EXPECT_THAT(error.message, HasSubstr("disk"));
    EXPECT_GT(taken, 5U);
    EXPECT_LT(taken, 45U);
    ExpectHoldsExactly(*store, taken);
  }
  EXPECT_TRUE(store->AppendSegments(Pieces({taken})));
  ExpectHoldsExactly(*store, taken + 1);
  store.reset();
  store = OpenSqliteStore(dir / "routes.db").value();
  ExpectHoldsExactly(*store, taken + 1);
}

}  // namespace
}  // namespace trailcast::store
