// Stores of before: version 4 knew teachings by their revision's number, 4 and 5 kept what is known
// of a route column by column, and receipts in the segments' rows.
#include "services/store/src/sqlite_upgrade.h"

#include <fmt/format.h>

#include "services/base/unix_time.h"
#include "services/store/src/old_rows.h"
#include "services/store/src/rows.h"
#include "services/store/src/sqlite_tables.h"
#include "services/store/store_file.h"

namespace trailcast::store {
namespace {

class OldSqliteRow final : public OldRow {
 public:
  explicit OldSqliteRow(const SQLite::Statement& statement) : statement_(statement) {}
  [[nodiscard]] bool IsNull(int column) const override { return At(column).isNull(); }
  [[nodiscard]] std::string Text(int column) const override { return At(column).getString(); }
  [[nodiscard]] std::int64_t Number(int column) const override { return At(column).getInt64(); }
  [[nodiscard]] double Real(int column) const override { return At(column).getDouble(); }
  [[nodiscard]] route::Bytes Bytes(int column) const override { return ReadBytes(At(column)); }

 private:
  [[nodiscard]] SQLite::Column At(int column) const { return statement_.getColumn(column); }
  const SQLite::Statement& statement_;
};

// A row keeps its id, by which its tags and its place refer to it.
void CopyRoutes(SQLite::Database& db, const char* table, std::uint32_t version) {
  const OldSeal sealed = version == 4 ? OldSeal::kWithoutLabels : OldSeal::kOfAll;
  SQLite::Statement select(
      db, version == 4
              ? fmt::format("SELECT {}, {}, id FROM {}_old", OldColumns("revision", "0"),
                            NowUnixMs(), table)
              : fmt::format("SELECT {}, grown_unix_ms, id FROM {}_old", OldColumns(), table));
  SQLite::Statement insert(db, fmt::format("INSERT INTO {} ({}, grown_unix_ms, id) VALUES ({})",
                                           table, kRouteColumns, Marks(kRouteColumnCount + 2)));
  while (select.executeStep()) {
    const OldRoute old = ReadOldRow(OldSqliteRow(select), sealed);
    BindRoute(insert, old.info);
    if (!old.whole) BindDigest(insert, kRouteColumnCount, {});
    insert.bind(kRouteColumnCount + 1, select.getColumn(kOldColumnCount).getInt64());
    insert.bind(kRouteColumnCount + 2, select.getColumn(kOldColumnCount + 1).getInt64());
    insert.exec();
    insert.reset();
  }
}

}  // namespace

void BringUpToDate(SQLite::Database& db, std::uint32_t version) {
  SQLite::Transaction transaction(db, SQLite::TransactionBehavior::EXCLUSIVE);
  for (const char* table : {"route", "tombstone", "segment"}) {
    db.exec(fmt::format("ALTER TABLE {0} RENAME TO {0}_old", table));
  }
  for (const char* index : {"route_by_name", "route_by_time", "route_by_length", "route_by_scout",
                            "segment_unreceipted", "segment_by_digest"}) {
    db.exec(fmt::format("DROP INDEX {}", index));
  }
  CreateRowTables(db);
  for (const char* table : {"route", "tombstone"}) CopyRoutes(db, table, version);
  const std::string key = fmt::format("route, {}, number", version == 4 ? "revision" : "teaching");
  db.exec(fmt::format(
      "INSERT INTO receipt SELECT {} FROM segment_old WHERE receipted = 1 ORDER BY 1, 2, 3", key));
  db.exec(fmt::format("INSERT INTO segment SELECT {}, digest, seal, bytes FROM segment_old", key));
  for (const char* table : {"route", "tombstone", "segment"}) {
    db.exec(fmt::format("DROP TABLE {}_old", table));
  }
  db.exec(fmt::format("PRAGMA user_version = {}", kSchemaVersion));
  transaction.commit();
}

}  // namespace trailcast::store
