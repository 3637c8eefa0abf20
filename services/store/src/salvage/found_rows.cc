#include "services/store/src/salvage/found_rows.h"

#include <algorithm>
#include <limits>
#include <map>
#include <string>
#include <tuple>

#include "services/store/src/row_values.h"

namespace trailcast::store {
namespace {

using Kind = RecordValue::Kind;

constexpr std::size_t kSegmentColumns = 6;
// The first column is the row's number, and the last tells when the route has grown.
constexpr std::size_t kColumnsOfRoute = kRouteColumnCount + 2;

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

// A file has whole numbers as such, even in columns of real ones.
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

}  // namespace

const std::vector<std::size_t>& ColumnsOfInterest() {
  static const std::vector<std::size_t> kColumns{kSegmentColumns, kColumnsOfRoute};
  return kColumns;
}

// The columns' order is that of sqlite_tables.cc.
std::optional<FoundSegment> ReadFoundSegment(const Record& record) {
  if (record.size() != kSegmentColumns) return std::nullopt;
  const auto where = WhereOf(record);
  const auto digest = DigestOf(record[3]);
  FoundSegment found;
  found.piece.bytes = Bytes(record[5]);
  if (!where || !digest) return found;
  std::tie(found.piece.key, found.piece.index) = *where;
  found.piece.digest = *digest;
  found.sealed = DigestOf(record[4]) == Seal(found.piece);
  return found;
}

std::optional<Result<route::RouteInfo>> ReadFoundRoute(const Record& record) {
  if (record.size() != kColumnsOfRoute) return std::nullopt;
  return OpenInfo(Bytes(record[kFoundByCount + 1]), Bytes(record[kFoundByCount + 2]),
                  [&](int column, const SqlValue& value) {
                    return Is(record[static_cast<std::size_t>(column) + 1], value);
                  });
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
