#include "services/store/src/postgres/postgres_upgrade.h"

#include "services/route/digest.h"
#include "services/route/info_codec.h"
#include "services/store/src/old_rows.h"
#include "services/store/src/postgres/postgres_rows.h"

namespace trailcast::store {
namespace {

constexpr int kBatch = 500;

class OldPostgresRow final : public OldRow {
 public:
  explicit OldPostgresRow(const pqxx::row& row) : row_(row) {}
  [[nodiscard]] bool IsNull(int column) const override { return row_[column].is_null(); }
  [[nodiscard]] std::string Text(int column) const override { return row_[column].c_str(); }
  [[nodiscard]] std::int64_t Number(int column) const override {
    return row_[column].as<std::int64_t>();
  }
  [[nodiscard]] double Real(int column) const override { return ReadDouble(row_[column]); }
  [[nodiscard]] route::Bytes Bytes(int column) const override { return ReadBytes(row_[column]); }

 private:
  const pqxx::row& row_;
};

// Fills in what the rows after `id` say, in the route format; the last one's id, or none.
std::optional<std::int64_t> FillInfos(pqxx::transaction_base& transaction, const char* table,
                                      std::int64_t id) {
  PostgresValues after;
  after.Add(id);
  const pqxx::result rows = after.Execute(
      transaction, fmt::format("SELECT {}, id FROM {} WHERE id > ? ORDER BY id LIMIT {}",
                               OldColumns("teaching", "cut_off::int"), table, kBatch));
  if (rows.empty()) return std::nullopt;
  PostgresValues values;
  for (const pqxx::row& row : rows) {
    const OldRoute old = ReadOldRow(OldPostgresRow(row), OldSeal::kOfAll);
    const route::Bytes bytes = route::EncodeInfo(old.info);
    id = row[kOldColumnCount].as<std::int64_t>();
    values.Add(id);
    values.AddBytes(bytes.data(), bytes.size());
    values.Add(old.whole ? route::Sha256(bytes) : route::Digest{});
  }
  (void)values.Execute(transaction,
                       fmt::format("UPDATE {0} SET info = new.info::bytea, seal = new.seal::bytea "
                                   "FROM (VALUES {1}) AS new (id, info, seal) "
                                   "WHERE {0}.id = new.id::bigint",
                                   table, values.Rows(3)));
  return id;
}

}  // namespace

void BringUpFrom2(pqxx::transaction_base& transaction) {
  for (const char* table : {"route", "tombstone"}) {
    transaction.exec(fmt::format("ALTER TABLE {} ADD COLUMN info bytea", table));
    for (std::optional<std::int64_t> id = 0; id;) id = FillInfos(transaction, table, *id);
    transaction.exec(fmt::format(
        "ALTER TABLE {} ALTER COLUMN info SET NOT NULL, DROP COLUMN image_width_px, "
        "DROP COLUMN image_height_px, DROP COLUMN bytes, DROP COLUMN manifest_digest, "
        "DROP COLUMN tags, DROP COLUMN description, DROP COLUMN edition, DROP COLUMN cut_off",
        table));
  }
  transaction.exec(
      "CREATE TABLE receipt AS SELECT route, teaching, number FROM segment WHERE receipted");
  transaction.exec("ALTER TABLE receipt ADD PRIMARY KEY (route, teaching, number)");
  transaction.exec("ALTER TABLE segment DROP COLUMN receipted");
  transaction.exec("UPDATE store SET version = 3");
}

}  // namespace trailcast::store
