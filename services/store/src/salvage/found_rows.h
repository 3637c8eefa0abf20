#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "services/base/result.h"
#include "services/route/route.h"
#include "services/store/src/salvage/sqlite_record.h"

namespace trailcast::store {

// These read rows that were found in a damaged file; nothing else here knows the tables' formats.
// How many columns a row has tells which table's it is.
[[nodiscard]] const std::vector<std::size_t>& ColumnsOfInterest();
inline constexpr std::size_t kReceiptColumns = 3;

struct FoundSegment {
  route::SegmentPiece piece;  // without bytes: another row's
  bool sealed = false;        // all but the bytes is as it was stored
};
// Nothing if it is no row of table `segment`. What it says may be damaged.
[[nodiscard]] std::optional<FoundSegment> ReadFoundSegment(const Record& record);

// Nothing if it is no row of tables `route` and `tombstone`; kCorrupt if it is damaged.
[[nodiscard]] std::optional<Result<route::RouteInfo>> ReadFoundRoute(const Record& record);

// Of the entries that one page of some index has, those that must be rows of table `receipt`: they
// have no seal, and the index of routes by key has entries of the same kind, one for each teaching.
[[nodiscard]] std::vector<std::pair<route::RouteKey, SegmentIndex>> ReadFoundReceipts(
    const std::vector<Record>& entries);

}  // namespace trailcast::store
