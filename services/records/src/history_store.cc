#include "services/records/history_store.h"

#include <SQLiteCpp/SQLiteCpp.h>

#include <utility>

#include "services/records/src/own_file.h"
#include "services/route/info_codec.h"

namespace trailcast::store {
namespace {

namespace fs = std::filesystem;

// `number` rises as changes are noted. A change that a server hears of late has an earlier
// `at_unix_ms`.
constexpr OwnFile kHistoryFile{.id = 0x54524348,  // "TRCH"
                               .version = 1,
                               .tables = R"(
CREATE TABLE change (
  number INTEGER PRIMARY KEY,
  at_unix_ms INTEGER NOT NULL,
  made_by TEXT NOT NULL,
  what TEXT NOT NULL
) STRICT;
CREATE INDEX change_at ON change (at_unix_ms);
CREATE TABLE kept (since_unix_ms INTEGER NOT NULL) STRICT;
CREATE TABLE noted (
  route TEXT NOT NULL,
  teaching INTEGER NOT NULL,
  info BLOB NOT NULL,
  PRIMARY KEY (route, teaching)
) STRICT, WITHOUT ROWID;
)",
                               .holds = "history",
                               .called = "store of the history"};

void BindKey(SQLite::Statement& statement, const route::RouteKey& key) {
  statement.bind(1, key.route.value());
  statement.bind(2, static_cast<std::int64_t>(key.teaching.value()));
}

}  // namespace

struct HistoryStore::Database : OwnDatabase {
  Database(const fs::path& file, std::int64_t most)
      : OwnDatabase(file, kHistoryFile), since_thinned_(most), most_kept(most) {}

  void Insert(const network::Change& change) {
    Run("INSERT INTO change (at_unix_ms, made_by, what) VALUES (?1, ?2, ?3)", change.at_unix_ms,
        change.by, change.what);
    ++since_thinned_;
  }

  void Note(const route::RouteInfo& info) {
    const bool gone = info.standing == route::Standing::kDeleted;
    auto note = compiled.Take(
        gone ? "DELETE FROM noted WHERE route = ?1 AND teaching = ?2"
             : "INSERT OR REPLACE INTO noted (route, teaching, info) VALUES (?1, ?2, ?3)");
    BindKey(*note, info.key);
    const route::Bytes bytes = route::EncodeInfo(info);
    if (!gone) note->bindNoCopy(3, bytes.data(), static_cast<int>(bytes.size()));
    note->exec();
  }

  // It works only now and then, because finding the oldest costs time, and with the first change of
  // each run, because a run may be too short to reach the bound.
  void Thin() {
    if (since_thinned_ <= most_kept / 100) return;
    since_thinned_ = 0;
    const std::string old = "FROM change WHERE number <= (SELECT max(number) FROM change) - " +
                            std::to_string(most_kept);
    db.exec("UPDATE kept SET since_unix_ms = max(since_unix_ms, coalesce((SELECT max(at_unix_ms) " +
            old + ") + 1, 0))");
    db.exec("DELETE " + old);
  }

  std::int64_t since_thinned_;
  std::int64_t most_kept;
};

HistoryStore::HistoryStore(std::unique_ptr<Database> database) : database_(std::move(database)) {}
HistoryStore::~HistoryStore() = default;

Result<std::unique_ptr<HistoryStore>> HistoryStore::Open(const fs::path& file,
                                                         std::int64_t most_kept) {
  using Opened = Result<std::unique_ptr<HistoryStore>>;
  return OwnDatabase::Guard(file, kHistoryFile, "opening it", [&]() -> Opened {
    return std::unique_ptr<HistoryStore>(
        new HistoryStore(std::make_unique<Database>(file, most_kept)));
  });
}

Result<std::int64_t> HistoryStore::KeptSince(std::int64_t now_unix_ms) {
  return database_->Guarded("reading since when it is kept", [&]() -> Result<std::int64_t> {
    database_->Run(
        "INSERT INTO kept (since_unix_ms) SELECT ?1 WHERE NOT EXISTS (SELECT 1 FROM kept)",
        now_unix_ms);
    return database_->db.execAndGet("SELECT since_unix_ms FROM kept").getInt64();
  });
}

Result<std::optional<route::RouteInfo>> HistoryStore::Noted(const route::RouteKey& key) {
  using Noted = Result<std::optional<route::RouteInfo>>;
  return database_->Guarded("reading a revision", [&]() -> Noted {
    auto select =
        database_->compiled.Take("SELECT info FROM noted WHERE route = ?1 AND teaching = ?2");
    BindKey(*select, key);
    if (!select->executeStep()) return std::nullopt;
    const auto column = select->getColumn(0);
    const auto* bytes = static_cast<const std::uint8_t*>(column.getBlob());
    auto info = route::DecodeInfo({bytes, static_cast<std::size_t>(column.getBytes())});
    if (!info) return tl::unexpected(info.error());
    return *std::move(info);
  });
}

Result<void> HistoryStore::Note(std::span<const network::Change> changes,
                                std::span<const route::RouteInfo> revisions) {
  return database_->AllOrNothing("storing a change", [&]() -> Result<void> {
    for (const network::Change& change : changes) database_->Insert(change);
    for (const route::RouteInfo& info : revisions) database_->Note(info);
    database_->Thin();
    return {};
  });
}

Result<std::vector<network::Change>> HistoryStore::Since(std::int64_t unix_ms, std::int64_t skip,
                                                         std::int64_t most) {
  using Changes = std::vector<network::Change>;
  return database_->Guarded("reading changes", [&]() -> Result<Changes> {
    auto select = database_->compiled.Take(
        "SELECT at_unix_ms, made_by, what FROM change WHERE at_unix_ms >= ?1 ORDER BY at_unix_ms, "
        "number LIMIT ?3 OFFSET ?2");
    select->bind(1, unix_ms);
    select->bind(2, skip);
    select->bind(3, most);
    Changes changes;
    while (select->executeStep()) {
      changes.push_back({.at_unix_ms = select->getColumn(0).getInt64(),
                         .by = select->getColumn(1).getString(),
                         .what = select->getColumn(2).getString()});
    }
    return changes;
  });
}

}  // namespace trailcast::store
