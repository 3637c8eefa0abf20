#include "services/store/src/salvage/salvaging.h"

#include <map>
#include <span>

#include "services/route/digest.h"
#include "services/store/lacking.h"
#include "services/store/sqlite_database.h"
#include "services/store/src/row_values.h"
#include "services/store/src/salvage/found_rows.h"
#include "services/store/src/salvage/page_scan.h"
#include "services/store/store_file.h"

namespace trailcast::store {
namespace {

constexpr std::size_t kBatch = 256;

using Age = PageScan::Age;
using Where = std::pair<route::RouteKey, SegmentIndex>;

class Salvaging {
 public:
  Salvaging(SqlitePages& pages, RouteStore& whole)
      : pages_(pages), scan_(pages, ColumnsOfInterest()), whole_(whole) {}

  // Returns what is lost, apart from what complete routes lack.
  Result<std::vector<std::string>> Run() {
    for (auto part : {&Salvaging::SaveRows, &Salvaging::SaveRelying, &Salvaging::SaveNamed,
                      &Salvaging::SaveReceipts, &Salvaging::TellLost}) {
      if (auto done = (this->*part)(); !done) return tl::unexpected(done.error());
    }
    return std::move(lost_);
  }

 private:
  Result<void> SaveRows() {
    const auto take = [this](const Record& record, Age age) -> Result<bool> {
      if (auto segment = ReadFoundSegment(record)) return TakeSegment(std::move(*segment), age);
      if (auto info = ReadFoundRoute(record)) return TakeRoute(std::move(*info), age);
      return true;
    };
    scan_.AlsoEntries(kReceiptColumns, [this](const std::vector<Record>& entries) {
      for (const auto& [key, index] : ReadFoundReceipts(entries)) receipted_[key].push_back(index);
    });
    if (auto scanned = scan_.Run(take); !scanned) return scanned;
    if (auto flushed = FlushRoutes(); !flushed) return flushed;
    return FlushSegments();
  }

  // If several are found of one revision, the store keeps the latest.
  Result<bool> TakeRoute(Result<route::RouteInfo> info, Age age) {
    if (!info) {
      NoteDamaged(age);
      return true;
    }
    routes_.push_back(std::move(*info));
    if (routes_.size() < kBatch) return true;
    return FlushRoutes().map([] { return true; });
  }

  Result<bool> TakeSegment(FoundSegment found, Age age) {
    route::SegmentPiece& piece = found.piece;
    if (!found.sealed) {
      NoteDamaged(age);
      return true;
    }
    if (!piece.bytes.empty() && route::CheckDigest(piece)) {
      return Save(std::move(piece)).map([] { return true; });
    }
    named_[{piece.key, piece.index}] = piece.digest;
    return piece.bytes.empty();
  }

  // Saves segments that rely on another's bytes if these were saved, and also those whose own are
  // damaged.
  Result<void> SaveRelying() {
    for (auto at = named_.begin(); at != named_.end();) {
      auto content = whole_.FindContent(at->second);
      if (!content) return tl::unexpected(content.error());
      if (!*content) {
        ++at;
        continue;
      }
      const auto& [where, digest] = *at;
      if (auto saved = Save({where.first, where.second, digest, std::move(**content)}); !saved) {
        return saved;
      }
      at = named_.erase(at);
    }
    return FlushSegments();
  }

  // The bytes of the others may be in rows that have lost their names.
  Result<void> SaveNamed() {
    if (named_.empty()) return {};
    std::multimap<route::Digest, Where> wanted;
    for (const auto& [where, digest] : named_) wanted.emplace(digest, where);
    const auto take = [&](const Record& record, Age) -> Result<bool> {
      const auto found = ReadFoundSegment(record);
      if (!found || found->piece.bytes.empty()) return true;
      const route::Digest digest = route::Sha256(found->piece.bytes);
      const auto [from, to] = wanted.equal_range(digest);
      for (auto at = from; at != to; ++at) {
        const auto& [key, index] = at->second;
        if (auto saved = Save({key, index, digest, found->piece.bytes}); !saved) {
          return tl::unexpected(saved.error());
        }
        named_.erase(at->second);
      }
      return wanted.erase(digest) > 0;
    };
    if (auto scanned = PageScan(pages_, ColumnsOfInterest()).Run(take); !scanned) return scanned;
    return FlushSegments();
  }

  Result<void> Save(route::SegmentPiece piece) {
    pieces_.push_back(std::move(piece));
    return pieces_.size() < kBatch ? Result<void>() : FlushSegments();
  }

  Result<void> FlushRoutes() {
    auto flushed =
        Flush<route::RouteInfo>(routes_, [&](auto infos) { return whole_.PutRoutes(infos); });
    routes_.clear();
    return flushed;
  }
  Result<void> FlushSegments() {
    auto flushed = Flush<route::SegmentPiece>(
        pieces_, [&](auto pieces) { return whole_.AppendSegments(pieces); });
    pieces_.clear();
    return flushed;
  }

  // An item that the new store refuses, as of a deleted revision, does not stop the rest. A store
  // that takes nothing, on a full disk, does, because everything unwritten would count as lost.
  template <typename Item, typename Store>
  static Result<void> Flush(std::span<const Item> items, const Store& store) {
    Result<void> stored = store(items);
    if (stored || stored.error().code == ErrorCode::kUnavailable) return stored;
    if (items.size() == 1) return {};
    for (const Item& item : items) {
      if (auto alone = Flush<Item>({&item, 1}, store); !alone) return alone;
    }
    return {};
  }

  // Saves the certain ones. A segment without its acknowledgement is only offered again.
  Result<void> SaveReceipts() {
    for (const auto& [key, indices] : receipted_) {
      if (auto noted = whole_.MarkReceipted(key, indices); !noted) return noted;
    }
    return {};
  }

  void NoteDamaged(Age age) { damaged_rows_ += age == Age::kCurrent ? 1 : 0; }

  Result<void> TellLost() {
    if (auto told = TellNamed(); !told) return told;
    const std::size_t rows = damaged_rows_ + scan_.unread_rows();
    if (rows > 0) {
      lost_.push_back(
          fmt::format("{} of the file's rows {} damaged", rows, rows == 1 ? "is" : "are"));
    }
    if (const std::size_t pages = scan_.unread_pages(); pages > 0) {
      lost_.push_back(fmt::format("perhaps more: {} of the file's {} pages cannot be read", pages,
                                  pages_.pages()));
    }
    return {};
  }

  // Tells segments of routes that are not complete; the same code reports for all stores what the
  // others lack.
  Result<void> TellNamed() {
    std::map<route::RouteKey, std::vector<SegmentIndex>> segments;
    for (const auto& [where, digest] : named_) segments[where.first].push_back(where.second);
    for (const auto& [key, indices] : segments) {
      const auto info = whole_.FindRoute(key);
      if (!info) return tl::unexpected(info.error());
      const bool told = *info && ((*info)->state == route::RouteState::kComplete ||
                                  (*info)->standing == route::Standing::kDeleted);
      if (!told) {
        lost_.push_back(fmt::format("{} of {}", DescribeSegments(indices), Describe(key)));
      }
    }
    return {};
  }

  SqlitePages& pages_;
  PageScan scan_;
  RouteStore& whole_;
  std::vector<route::RouteInfo> routes_;
  std::vector<route::SegmentPiece> pieces_;
  std::map<Where, route::Digest> named_;  // whose bytes were not found yet
  std::map<route::RouteKey, std::vector<SegmentIndex>> receipted_;
  std::size_t damaged_rows_ = 0;
  std::vector<std::string> lost_;
};

// Counts what the new store has, and adds routes of which nothing is known to the lost things.
void Count(SQLite::Database& whole, Salvaged& salvaged) {
  const auto count = [&](const char* table) {
    return static_cast<std::size_t>(
        whole.execAndGet(fmt::format("SELECT COUNT(*) FROM {}", table)).getInt64());
  };
  salvaged.routes = count("route");
  salvaged.segments = count("segment");
  SQLite::Statement unknown(whole,
                            "SELECT route, teaching, COUNT(*) FROM segment WHERE NOT EXISTS "
                            "(SELECT 1 FROM route WHERE route.route = segment.route AND "
                            "route.teaching = segment.teaching) GROUP BY route, teaching");
  while (unknown.executeStep()) {
    const route::RouteKey key{
        RouteId(unknown.getColumn(0).getString()),
        TeachingId(static_cast<std::uint64_t>(unknown.getColumn(1).getInt64()))};
    salvaged.lost.push_back(
        fmt::format("what is known of {}; its {} segments are kept until a holder announces it",
                    Describe(key), unknown.getColumn(2).getInt64()));
  }
}

}  // namespace

Result<Salvaged> SaveWhole(const std::filesystem::path& from, const std::filesystem::path& to,
                           const SqliteOptions& options) {
  SqlitePages pages(from);
  Salvaged salvaged;
  {
    auto whole = OpenSqliteStore(to, options);
    if (!whole) return tl::unexpected(whole.error());
    auto lost = Salvaging(pages, **whole).Run();
    if (!lost) return tl::unexpected(lost.error());
    salvaged.lost = std::move(*lost);
    const auto lacking = FindLacking(**whole);
    if (!lacking) return tl::unexpected(lacking.error());
    for (const LackingRoute& route : *lacking) salvaged.lost.push_back(Describe(route));
  }
  try {
    const auto whole = OpenDatabase(to, {});
    if (!whole) return tl::unexpected(whole.error());
    Count(**whole, salvaged);
  } catch (const SQLite::Exception& exception) {
    return tl::unexpected(ToError(exception, to, "counting what was saved"));
  }
  if (pages.is_store() || salvaged.routes + salvaged.segments > 0) return salvaged;
  return Fail(ErrorCode::kCorrupt, "there is nothing of a route store of version {} in {}",
              kSchemaVersion, from.string());
}

}  // namespace trailcast::store
