// A store's file, with or without a log, with changed bytes and a changed end: whatever is read of
// it is whole, and what is salvaged is a store without damage. An input is not the file but what
// happened to it: places and the bytes put there.
#include <fuzzer/FuzzedDataProvider.h>

#include <algorithm>
#include <iterator>
#include <string>
#include <vector>

#include "services/route/digest.h"
#include "services/store/salvage.h"
#include "tests/fuzz/fuzz.h"
#include "tests/support/pieces.h"
#include "tests/support/temp_dir.h"

namespace trailcast::fuzz {
namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr std::uint32_t kSegments = 5;

route::SegmentPiece PieceOf(const route::RouteKey& key, std::uint32_t index) {
  route::SegmentPiece piece = test::PieceOf(key, index, 1500);
  piece.digest = route::Sha256(piece.bytes);
  return piece;
}

Bytes Read(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

struct Whole {
  Bytes file;
  Bytes log;  // that has what is not in `beginning`
  Bytes beginning;
};

Whole WholeStore(const std::filesystem::path& file) {
  Whole whole;
  {
    const auto store = store::OpenSqliteStore(file).value();
    for (unsigned route = 0; route < 3; ++route) {
      const route::RouteKey key = test::KeyNumber(route);
      std::vector<route::SegmentPiece> pieces;
      std::vector<route::Digest> digests;
      for (std::uint32_t i = 0; i < kSegments; ++i) {
        pieces.push_back(PieceOf(key, i));
        digests.push_back(pieces.back().digest);
      }
      route::RouteInfo info = test::InfoOf(key, pieces, route::RouteState::kComplete);
      info.manifest_digest = route::ManifestDigest(digests);
      info.tags = {"indoor"};
      info.place = {route::Place::Frame::kSite, 1.0 * route, 2.0};
      Require(store->AppendSegments(pieces) && store->PutRoute(info), "the store was made");
    }
    whole.beginning = Read(file);
    whole.log = Read(file.string() + "-wal");
  }
  whole.file = Read(file);
  return whole;
}

Bytes Damaged(Bytes file, FuzzedDataProvider& input) {
  if (input.ConsumeIntegral<std::uint8_t>() == 0) {
    file.resize(input.ConsumeIntegralInRange<std::size_t>(0, file.size()));
  }
  const auto changes = input.ConsumeIntegral<std::uint8_t>();
  for (int i = 0; i < changes && input.remaining_bytes() > 0 && !file.empty(); ++i) {
    const auto at = input.ConsumeIntegralInRange<std::size_t>(0, file.size() - 1);
    const auto bytes = input.ConsumeBytes<std::uint8_t>(
        std::min(input.ConsumeIntegralInRange<std::size_t>(1, 8), file.size() - at));
    std::copy(bytes.begin(), bytes.end(), file.begin() + static_cast<std::ptrdiff_t>(at));
  }
  return file;
}

void ReadAll(store::RouteStore& store) {
  const auto damage = store.Verify();
  const auto routes = store.ListRoutes();
  for (unsigned route = 0; route < 3; ++route) {
    const route::RouteKey key = test::KeyNumber(route);
    const auto info = store.FindRoute(key);
    Require(!info || !*info || (*info)->key == key, "a route is the one asked for");
    for (std::uint32_t i = 0; i <= kSegments; ++i) {
      const auto piece = store.ReadSegment(key, SegmentIndex(i));
      Require(!piece || *piece == PieceOf(key, i), "a segment that is read is whole");
    }
    const auto held = store.HeldSegments(key);
    const auto unreceipted = store.UnreceiptedSegments(key);
  }
  for (const auto order : {route::RouteOrder::kNewest, route::RouteOrder::kName}) {
    const auto page = store.QueryRoutes({.tags = {"indoor"}, .order = order, .page_size = 2});
  }
  const auto names = store.NamesNear("corridor", 3);
  const auto appended = store.AppendSegments(
      std::vector{PieceOf(test::KeyNumber(0), 1), PieceOf(test::KeyNumber(9), 1)});
  const auto receipted = store.MarkReceipted(test::KeyNumber(1), std::vector{SegmentIndex(2)});
}

void SalvageAll(const std::filesystem::path& from, const std::filesystem::path& to) {
  const auto salvaged = store::Salvage(from, to);
  Require(std::filesystem::exists(to) == salvaged.has_value(), "there is a new store or an error");
  if (!salvaged) return;
  {
    const auto store = store::OpenSqliteStore(to);
    Require(store && (*store)->Verify().value().empty(), "a salvaged store has no damage");
    Require(salvaged->segments <= 3 * kSegments + 1, "no segment is saved twice");
  }
  std::filesystem::remove(to);
}

}  // namespace
}  // namespace trailcast::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace trailcast::fuzz;
  static const trailcast::test::TempDir folder;
  static const Whole whole = WholeStore(folder / "whole.db");
  FuzzedDataProvider input(data, size);
  const bool with_log = input.ConsumeBool();
  const Bytes damaged = Damaged(with_log ? whole.beginning : whole.file, input);
  const std::filesystem::path file = AsFile(damaged, "store.db");
  for (const char* log : {"-wal", "-journal"}) std::filesystem::remove(file.string() + log);
  if (with_log) AsFile(Damaged(whole.log, input), "store.db-wal");
  SalvageAll(file, folder / "salvaged.db");
  if (const auto store = trailcast::store::OpenSqliteStore(file)) ReadAll(**store);
  return 0;
}
