#include "services/records/age_store.h"

#include <SQLiteCpp/SQLiteCpp.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "services/records/src/own_file.h"

namespace trailcast::store {
namespace {

namespace fs = std::filesystem;
using std::chrono::milliseconds;

constexpr milliseconds kDay = std::chrono::hours(24);

// `passed_ms` is the time that has passed so far, and `day` the last of its days on which something
// was deleted. A revision is unchanged since `since_ms` of that time.
constexpr OwnFile kAgeFile{.id = 0x54524341,  // "TRCA"
                           .version = 1,
                           .tables = R"(
CREATE TABLE passed (
  number INTEGER PRIMARY KEY CHECK (number = 1),
  passed_ms INTEGER NOT NULL,
  day INTEGER NOT NULL,
  deleted INTEGER NOT NULL
) STRICT;
INSERT INTO passed VALUES (1, 0, 0, 0);
CREATE TABLE revision (
  route TEXT NOT NULL,
  teaching INTEGER NOT NULL,
  mark INTEGER NOT NULL,
  since_ms INTEGER NOT NULL,
  PRIMARY KEY (route, teaching)
) STRICT, WITHOUT ROWID;
)",
                           .holds = "ages of revisions",
                           .called = "store of ages"};

}  // namespace

struct AgeStore::Database : OwnDatabase {
  explicit Database(const fs::path& file)
      : OwnDatabase(file, kAgeFile), passed(Count("SELECT passed_ms FROM passed")), kept(passed) {}

  void KeepPassed() {
    auto update = compiled.Take("UPDATE passed SET passed_ms = ?1");
    update->bind(1, static_cast<std::int64_t>(passed.count()));
    update->exec();
  }

  // Returns nothing if the revision is not known here or was different.
  std::optional<milliseconds> Since(const Marked& revision) {
    auto select = compiled.Take(
        "SELECT since_ms FROM revision WHERE route = ?1 AND teaching = ?2 AND mark = ?3");
    Bind(*select, revision);
    if (!select->executeStep()) return std::nullopt;
    return milliseconds(select->getColumn(0).getInt64());
  }

  void Note(const Marked& revision) {
    auto note = compiled.Take(
        "INSERT OR REPLACE INTO revision (route, teaching, mark, since_ms) VALUES (?1, ?2, ?3, "
        "?4)");
    Bind(*note, revision);
    note->bind(4, static_cast<std::int64_t>(passed.count()));
    note->exec();
  }

  static void Bind(SQLite::Statement& statement, const Marked& revision) {
    statement.bind(1, revision.first.route.value());
    statement.bind(2, static_cast<std::int64_t>(revision.first.teaching.value()));
    statement.bind(3, revision.second);
  }

  milliseconds passed;
  milliseconds kept;  // the part of it that is on the disk
};

AgeStore::AgeStore(std::unique_ptr<Database> database) : database_(std::move(database)) {}
AgeStore::~AgeStore() = default;

Result<std::unique_ptr<AgeStore>> AgeStore::Open(const fs::path& file) {
  using Opened = Result<std::unique_ptr<AgeStore>>;
  return OwnDatabase::Guard(file, kAgeFile, "opening it", [&]() -> Opened {
    return std::unique_ptr<AgeStore>(new AgeStore(std::make_unique<Database>(file)));
  });
}

Result<void> AgeStore::Pass(milliseconds time) {
  database_->passed += time;
  if (database_->passed - database_->kept < kKeptEvery) return {};
  return database_->Guarded("storing how much time has passed", [&]() -> Result<void> {
    database_->KeepPassed();
    database_->kept = database_->passed;
    return {};
  });
}

Result<std::vector<milliseconds>> AgeStore::AgesOf(const std::vector<Marked>& revisions) {
  using Ages = std::vector<milliseconds>;
  return database_->Guarded("storing since when revisions are as they are", [&]() -> Result<Ages> {
    Ages ages;
    std::optional<SQLite::Transaction> news;
    for (const Marked& revision : revisions) {
      const auto since = database_->Since(revision);
      ages.push_back(since ? database_->passed - *since : milliseconds(0));
      if (since) continue;
      if (!news) news.emplace(database_->db, SQLite::TransactionBehavior::IMMEDIATE);
      database_->Note(revision);
    }
    if (!news) return ages;
    database_->KeepPassed();  // so that no time on the disk is still to come
    news->commit();
    database_->kept = database_->passed;
    return ages;
  });
}

Result<std::uint32_t> AgeStore::Allow(std::uint32_t wanted, std::uint32_t most) {
  return database_->Guarded("storing how much was deleted", [&]() -> Result<std::uint32_t> {
    const std::int64_t day = database_->passed / kDay;
    const bool is_today = database_->Count("SELECT day FROM passed") == day;
    const std::int64_t deleted = is_today ? database_->Count("SELECT deleted FROM passed") : 0;
    const std::int64_t allowed =
        std::clamp<std::int64_t>(std::int64_t{most} - deleted, 0, std::int64_t{wanted});
    if (allowed == 0) return 0U;
    auto update =
        database_->compiled.Take("UPDATE passed SET passed_ms = ?1, day = ?2, deleted = ?3");
    update->bind(1, static_cast<std::int64_t>(database_->passed.count()));
    update->bind(2, day);
    update->bind(3, deleted + allowed);
    update->exec();
    database_->kept = database_->passed;
    return static_cast<std::uint32_t>(allowed);
  });
}

}  // namespace trailcast::store
