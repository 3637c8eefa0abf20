#include "services/store/salvage.h"

#include <sqlite3.h>

#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <span>

#include "services/route/digest.h"
#include "services/store/sqlite_database.h"
#include "services/store/src/rows.h"
#include "services/store/store_file.h"

namespace trailcast::store {
namespace {

using Rowid = std::int64_t;
constexpr Rowid kLastRowid = std::numeric_limits<std::int32_t>::max();
constexpr std::size_t kBatch = 256;

bool IsDamage(const SQLite::Exception& exception) {
  const int code = exception.getErrorCode() & 0xFF;
  return code == SQLITE_CORRUPT || code == SQLITE_NOTADB || code == SQLITE_IOERR;
}

// The rows of one table in the order in which they lie in the file, unreadable stretches passed
// over: a damaged page costs the rows on it.
class RowWalk {
 public:
  RowWalk(SQLite::Database& db, const std::string& table, const char* columns)
      : select_(db, fmt::format("SELECT {}, rowid FROM {} NOT INDEXED WHERE rowid > ? "
                                "ORDER BY rowid LIMIT 1",
                                columns, table)) {}

  // The next readable row; nullptr after the last.
  const SQLite::Statement* Next() {
    if (const auto found = After(last_)) return Take(*found);
    if (!damaged_) return nullptr;
    ++stretches_;
    // Which row is the first beyond the damage is found by doubling, then by halving.
    Rowid step = 1;
    while (last_ + step < kLastRowid && !After(last_ + step) && damaged_) step *= 2;
    if (last_ + step >= kLastRowid || !After(last_ + step)) return nullptr;
    Rowid bad = step / 2;
    while (bad + 1 < step) {
      const Rowid middle = bad + (step - bad) / 2;
      (After(last_ + middle) ? step : bad) = middle;
    }
    return Take(*After(last_ + step));
  }
  [[nodiscard]] int stretches() const { return stretches_; }

 private:
  std::optional<Rowid> After(Rowid rowid) {
    damaged_ = false;
    try {
      select_.tryReset();
      select_.bind(1, rowid);
      if (!select_.executeStep()) return std::nullopt;
      const Rowid found = select_.getColumn(select_.getColumnCount() - 1).getInt64();
      // A damaged number, or a page in another's place, can lie before the row asked for: the walk
      // would go round for ever.
      if (found > rowid && found < kLastRowid) return found;
      damaged_ = true;
    } catch (const SQLite::Exception& exception) {
      if (!IsDamage(exception)) throw;
      damaged_ = true;
    }
    return std::nullopt;
  }
  const SQLite::Statement* Take(Rowid rowid) {
    last_ = rowid;
    return &select_;
  }

  SQLite::Statement select_;
  Rowid last_ = 0;
  bool damaged_ = false;  // the last After met some
  int stretches_ = 0;
};

// Runs `read` on a row; nothing if that meets damage (what lies on other pages is read only then).
template <typename Read>
auto Readable(const Read& read) -> std::optional<typename decltype(read())::value_type> {
  try {
    if (auto value = read()) return std::move(*value);
  } catch (const SQLite::Exception& exception) {
    if (!IsDamage(exception)) throw;
  }
  return std::nullopt;
}

class Salvaging {
 public:
  Salvaging(SQLite::Database& damaged, RouteStore& whole) : damaged_(damaged), whole_(whole) {}

  Result<Salvaged> Run() {
    for (auto part : {&Salvaging::SaveTombstones, &Salvaging::SaveRoutes, &Salvaging::SaveSegments,
                      &Salvaging::SaveRelying, &Salvaging::SaveReceipts, &Salvaging::TellLost}) {
      if (auto done = (this->*part)(); !done) return tl::unexpected(done.error());
    }
    return std::move(salvaged_);
  }

 private:
  // First, so that what else is there of a deleted revision is refused.
  Result<void> SaveTombstones() { return SaveInfos("tombstone"); }
  Result<void> SaveRoutes() { return SaveInfos("route"); }

  Result<void> SaveInfos(const char* table) {
    RowWalk rows(damaged_, table, kRouteColumns);
    while (const SQLite::Statement* row = rows.Next()) {
      auto info = Readable([&] { return ReadRoute(*row); });
      if (info) routes_.push_back(std::move(*info));
      if (routes_.size() < kBatch) continue;
      if (auto flushed = FlushRoutes(); !flushed) return flushed;
    }
    TellStretches(std::string(table) + "s", rows.stretches());
    return FlushRoutes();
  }

  Result<void> SaveSegments() {
    const std::string columns = std::string(kSegmentContent) + ", route, teaching, number";
    RowWalk rows(damaged_, "segment", columns.c_str());
    while (const SQLite::Statement* row = rows.Next()) {
      auto piece = Readable([&]() -> Result<route::SegmentPiece> {
        const route::RouteKey key{RouteId(row->getColumn(3).getString()),
                                  TeachingOf(row->getColumn(4))};
        return ReadSegmentRow(*row, key, SegmentIndex(row->getColumn(5).getUInt()));
      });
      if (!piece) continue;
      const bool relies = piece->bytes.empty();
      if (!relies && !route::CheckDigest(*piece)) continue;
      if (relies) {
        relying_.push_back(std::move(*piece));
      } else if (auto saved = Save(std::move(*piece)); !saved) {
        return saved;
      }
    }
    TellStretches("segments", rows.stretches());
    return FlushSegments();
  }

  // Those that rely on another's bytes, if these were saved.
  Result<void> SaveRelying() {
    for (route::SegmentPiece& piece : relying_) {
      auto content = whole_.FindContent(piece.digest);
      if (!content) return tl::unexpected(content.error());
      if (!*content) continue;
      piece.bytes = std::move(**content);
      if (auto saved = Save(std::move(piece)); !saved) return saved;
    }
    return FlushSegments();
  }

  Result<void> Save(route::SegmentPiece piece) {
    pieces_.push_back(std::move(piece));
    return pieces_.size() < kBatch ? Result<void>() : FlushSegments();
  }

  Result<void> FlushRoutes() {
    auto flushed = Flush<route::RouteInfo>(
        routes_, [&](auto infos) { return whole_.PutRoutes(infos); }, salvaged_.routes);
    routes_.clear();
    return flushed;
  }
  Result<void> FlushSegments() {
    auto flushed = Flush<route::SegmentPiece>(
        pieces_, [&](auto pieces) { return whole_.AppendSegments(pieces); }, salvaged_.segments);
    pieces_.clear();
    return flushed;
  }

  // What the new store refuses, like a row that is there twice, is not worth more than the rest. A
  // store that takes nothing, on a full disk, ends it: what was not written would count as lost.
  template <typename Item, typename Store>
  static Result<void> Flush(std::span<const Item> items, const Store& store, std::size_t& saved) {
    Result<void> stored = store(items);
    if (stored) {
      saved += items.size();
      return {};
    }
    if (stored.error().code == ErrorCode::kUnavailable) return stored;
    if (items.size() == 1) return {};
    for (const Item& item : items) {
      if (auto alone = Flush<Item>({&item, 1}, store, saved); !alone) return alone;
    }
    return {};
  }

  // As far as they can be read in one go: a segment without its receipt is only offered again.
  Result<void> SaveReceipts() {
    std::map<route::RouteKey, std::vector<SegmentIndex>> receipted;
    try {
      SQLite::Statement select(damaged_, "SELECT route, teaching, number FROM receipt");
      while (select.executeStep()) {
        receipted[{RouteId(select.getColumn(0).getString()), TeachingOf(select.getColumn(1))}]
            .emplace_back(select.getColumn(2).getUInt());
      }
    } catch (const SQLite::Exception& exception) {
      if (!IsDamage(exception)) throw;
    }
    for (const auto& [key, indices] : receipted) {
      if (auto noted = whole_.MarkReceipted(key, indices); !noted) return noted;
    }
    return {};
  }

  void TellStretches(const std::string& of, int stretches) {
    if (stretches == 0) return;
    salvaged_.lost.push_back(
        fmt::format("{} of the file's {}", stretches == 1 ? "a part" : "several parts", of));
  }

  // A line for each run of segments.
  void TellMissing(const route::RouteInfo& info, const std::vector<SegmentIndex>& held) {
    const auto holds = [&](std::uint32_t i) {
      return std::binary_search(held.begin(), held.end(), SegmentIndex(i));
    };
    for (std::uint32_t i = 0; i < info.segment_count; ++i) {
      if (holds(i)) continue;
      const std::uint32_t first = i;
      while (i + 1 < info.segment_count && !holds(i + 1)) ++i;
      salvaged_.lost.push_back(fmt::format(
          "{} of {} '{}'",
          first == i ? fmt::format("segment {}", i) : fmt::format("segments {} to {}", first, i),
          Describe(info.key), info.name));
    }
  }

  Result<void> TellLost() {
    auto routes = whole_.ListRoutes();
    if (!routes) return tl::unexpected(routes.error());
    for (const route::RouteInfo& info : *routes) {
      if (info.state != route::RouteState::kComplete) continue;
      auto held = whole_.HeldSegments(info.key);
      if (!held) return tl::unexpected(held.error());
      TellMissing(info, *held);
    }
    return {};
  }

  SQLite::Database& damaged_;
  RouteStore& whole_;
  std::vector<route::RouteInfo> routes_;
  std::vector<route::SegmentPiece> pieces_;
  std::vector<route::SegmentPiece> relying_;  // their bytes are another's
  Salvaged salvaged_;
};

// The store's file and its log, to be read and thrown away.
class Copy {
 public:
  Copy(const std::filesystem::path& of, const std::filesystem::path& at) : path_(at) {
    for (const char* part : {"", "-wal"}) {
      const std::filesystem::path source = of.string() + part;
      if (std::filesystem::exists(source)) {
        std::filesystem::copy_file(source, path_.string() + part);
      }
    }
  }
  ~Copy() {
    std::error_code ignored;
    for (const char* part : {"", "-wal", "-shm", "-journal"}) {
      std::filesystem::remove(path_.string() + part, ignored);
    }
  }
  Copy(const Copy&) = delete;
  Copy& operator=(const Copy&) = delete;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

Result<Salvaged> SaveWhole(const std::filesystem::path& from, const std::filesystem::path& to,
                           const SqliteOptions& options) {
  try {
    const Copy copy(from, to.string() + ".copy");
    SQLite::Database damaged(copy.path().string(), SQLite::OPEN_READWRITE);
    damaged.exec("PRAGMA writable_schema = ON");  // SQLite then reads what was cut short
    if (const auto version = damaged.execAndGet("PRAGMA user_version").getUInt();
        version != kSchemaVersion) {
      return Fail(
          ErrorCode::kCorrupt,
          "route store {} has version {}, expected {}: an older one is saved by the program "
          "that wrote it",
          from.string(), version, kSchemaVersion);
    }
    auto whole = OpenSqliteStore(to, options);
    if (!whole) return tl::unexpected(whole.error());
    return Salvaging(damaged, **whole).Run();
  } catch (const SQLite::Exception& exception) {
    return tl::unexpected(ToError(exception, from, "saving what is whole of it"));
  } catch (const std::filesystem::filesystem_error& error) {
    return Fail(ErrorCode::kUnavailable, "cannot copy route store {}: {}", from.string(),
                error.what());
  }
}

}  // namespace

Result<Salvaged> Salvage(const std::filesystem::path& from, const std::filesystem::path& to,
                         const SqliteOptions& options) {
  std::error_code ignored;
  if (std::filesystem::exists(to, ignored)) {
    return Fail(ErrorCode::kConflict, "{} exists already; move it away first", to.string());
  }
  if (!std::filesystem::exists(from, ignored)) {
    return Fail(ErrorCode::kNotFound, "there is no route store {}", from.string());
  }
  const auto locked = StoreFile::Acquire(from, StoreFile::Condition::kDamaged);
  if (!locked) return tl::unexpected(locked.error());
  auto salvaged = SaveWhole(from, to, options);
  if (!salvaged) std::filesystem::remove(to, ignored);
  return salvaged;
}

}  // namespace trailcast::store
