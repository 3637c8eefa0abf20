#include "services/store/src/salvage/found_rows.h"

#include <algorithm>
#include <limits>
#include <map>
#include <string>
#include <tuple>

#include "services/store/src/old_rows.h"
#include "services/store/src/row_values.h"

namespace trailcast::store {
namespace {

using Kind = RecordValue::Kind;

constexpr std::size_t kSegmentColumns = 6;
constexpr std::size_t kSegmentColumnsBefore6 = 7;  // their fourth: whether it was receipted
// Their first is the row's number, their last, but in version 4, when the route has grown.
constexpr std::size_t kColumnsOfRoute = kRouteColumnCount + 2;
constexpr std::size_t kColumnsOfRoute5 = kOldColumnCount + 2;
constexpr std::size_t kColumnsOfRoute4 = 22;
constexpr int kRevisionOf4 = 1;

std::string Text(const RecordValue& value) { return {value.bytes.begin(), value.bytes.end()}; }

route::Bytes Bytes(const RecordValue& value) { return {value.bytes.begin(), value.bytes.end()}; }

std::optional<route::Digest> DigestOf(const RecordValue& value) {
  route::Digest digest{};
  if (value.kind != Kind::kBlob || value.bytes.size() != digest.size()) return std::nullopt;
  std::copy(value.bytes.begin(), value.bytes.end(), digest.begin());
  return digest;
}

std::optional<std::pair<route::RouteKey, SegmentIndex>> WhereOf(const Record& record) {
  const RecordValue& teaching = record[1];
  const RecordValue& number = record[2];
  if (record[0].kind != Kind::kText || teaching.kind != Kind::kInteger || number.integer < 0 ||
      number.kind != Kind::kInteger || number.integer > std::numeric_limits<std::uint32_t>::max()) {
    return std::nullopt;
  }
  return std::pair(route::RouteKey{RouteId(Text(record[0])),
                                   TeachingId(static_cast<std::uint64_t>(teaching.integer))},
                   SegmentIndex(static_cast<std::uint32_t>(number.integer)));
}

// Whole numbers lie as such in a file, in columns of real ones too.
double Real(const RecordValue& value) {
  return value.kind == Kind::kInteger ? static_cast<double>(value.integer) : value.real;
}

bool Is(const RecordValue& found, const SqlValue& value) {
  if (const auto* text = std::get_if<std::string>(&value)) {
    return found.kind == Kind::kText && Text(found) == *text;
  }
  if (const auto* number = std::get_if<std::int64_t>(&value)) {
    return found.kind == Kind::kInteger && found.integer == *number;
  }
  const auto* real = std::get_if<double>(&value);
  return real != nullptr ? Real(found) == *real : found.kind == Kind::kNull;
}

// Of versions 4 and 5. Version 4 had no columns for who teaches and whether that was cut off.
class OldFoundRow final : public OldRow {
 public:
  explicit OldFoundRow(const Record& record) : record_(record) {}
  [[nodiscard]] bool IsNull(int column) const override { return At(column).kind == Kind::kNull; }
  [[nodiscard]] std::string Text(int column) const override { return store::Text(At(column)); }
  [[nodiscard]] std::int64_t Number(int column) const override { return At(column).integer; }
  [[nodiscard]] double Real(int column) const override { return store::Real(At(column)); }
  [[nodiscard]] route::Bytes Bytes(int column) const override { return store::Bytes(At(column)); }

 private:
  [[nodiscard]] const RecordValue& At(int column) const {
    static const RecordValue kNone;
    const bool of_4 = record_.size() == kColumnsOfRoute4;
    if (of_4 && column == kOldColumnCount - 1) return kNone;
    if (of_4 && column == kOldColumnCount - 2) return record_[kRevisionOf4 + 1];
    return record_[static_cast<std::size_t>(column) + 1];
  }
  const Record& record_;
};

}  // namespace

const std::vector<std::size_t>& ColumnsOfInterest() {
  static const std::vector<std::size_t> kColumns{
      kSegmentColumns, kSegmentColumnsBefore6, kColumnsOfRoute, kColumnsOfRoute4, kColumnsOfRoute5};
  return kColumns;
}

// The columns' order is that of sqlite_tables.cc, and was in the versions before.
std::optional<FoundSegment> ReadFoundSegment(const Record& record) {
  const bool before_6 = record.size() == kSegmentColumnsBefore6;
  if (!before_6 && record.size() != kSegmentColumns) return std::nullopt;
  const std::size_t content = before_6 ? 4 : 3;
  const auto where = WhereOf(record);
  const auto digest = DigestOf(record[content]);
  FoundSegment found;
  found.piece.bytes = Bytes(record[content + 2]);
  if (!where || !digest) return found;
  std::tie(found.piece.key, found.piece.index) = *where;
  found.piece.digest = *digest;
  found.receipted = before_6 && record[3].integer == 1;
  found.sealed = DigestOf(record[content + 1]) == Seal(found.piece);
  return found;
}

std::optional<Result<route::RouteInfo>> ReadFoundRoute(const Record& record) {
  if (record.size() == kColumnsOfRoute) {
    return OpenInfo(Bytes(record[kFoundByCount + 1]), Bytes(record[kFoundByCount + 2]),
                    [&](int column, const SqlValue& value) {
                      return Is(record[static_cast<std::size_t>(column) + 1], value);
                    });
  }
  const bool of_4 = record.size() == kColumnsOfRoute4;
  if (!of_4 && record.size() != kColumnsOfRoute5) return std::nullopt;
  OldRoute old = ReadOldRow(OldFoundRow(record), of_4 ? OldSeal::kWithoutLabels : OldSeal::kOfAll);
  if (old.whole) return std::move(old.info);
  return DamagedRoute(old.info.key, old.info.name);
}

std::vector<std::pair<route::RouteKey, SegmentIndex>> ReadFoundReceipts(
    const std::vector<Record>& entries) {
  std::map<route::RouteKey, std::vector<SegmentIndex>> numbers;
  for (const Record& entry : entries) {
    if (const auto where = WhereOf(entry)) numbers[where->first].push_back(where->second);
  }
  std::vector<std::pair<route::RouteKey, SegmentIndex>> receipts;
  for (const auto& [key, indices] : numbers) {
    if (indices.size() < 2) continue;
    for (const SegmentIndex index : indices) receipts.emplace_back(key, index);
  }
  return receipts;
}

}  // namespace trailcast::store
