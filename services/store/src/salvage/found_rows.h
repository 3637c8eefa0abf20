#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "services/base/result.h"
#include "services/route/route.h"
#include "services/store/src/salvage/sqlite_record.h"

namespace trailcast::store {

// These read rows that were found in a damaged file; nothing else here knows the tables' formats.
// The number of a row's columns tells its table.
[[nodiscard]] const std::vector<std::size_t>& ColumnsOfInterest();
inline constexpr std::size_t kReceiptColumns = 3;

struct FoundSegment {
  route::SegmentPiece piece;  // without bytes if they are in another row
  bool sealed = false;        // everything except the bytes is as it was stored
};
// Returns nothing if it is no row of table `segment`. Its values may be damaged.
[[nodiscard]] std::optional<FoundSegment> ReadFoundSegment(const Record& record);

// Returns nothing if it is no row of tables `route` and `tombstone`, and kCorrupt if it is damaged.
[[nodiscard]] std::optional<Result<route::RouteInfo>> ReadFoundRoute(const Record& record);

// Returns, from the entries of one page of some index, those that must be rows of table `receipt`.
// They have no seal, and the index of routes by key has entries of the same kind, one for each
// teaching.
[[nodiscard]] std::vector<std::pair<route::RouteKey, SegmentIndex>> ReadFoundReceipts(
    const std::vector<Record>& entries);

}  // namespace trailcast::store
