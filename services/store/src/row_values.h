#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <variant>
#include <vector>

#include "services/base/result.h"
#include "services/route/labels.h"
#include "services/route/route.h"

namespace trailcast::store {

// Behind lower-case hexadecimal digits: past all that begins with them.
inline constexpr const char* kAfterHexDigits = "g";

// What rows are made of, whatever database holds them.

using SqlValue = std::variant<std::monostate, std::string, std::int64_t, double>;  // first: NULL

// Columns of tables `route` and `tombstone`: by what rows are found and sorted; then what is known
// of the route, in the route format, which all others are made from; then its seal.
inline constexpr const char* kRouteColumns =
    "route, teaching, revision, name, scout, camera, taught_unix_ms, state, segment_count, "
    "length_m, standing, place_frame, place_east, place_north, info, seal";
inline constexpr int kFoundByCount = 14;
inline constexpr int kRouteColumnCount = kFoundByCount + 2;

// "?,?,?": parameters for so many columns.
[[nodiscard]] std::string Marks(int count);

// The first kFoundByCount of them.
[[nodiscard]] std::vector<SqlValue> FoundBy(const route::RouteInfo& info);
// What a row of kRouteColumns says, if its bytes fit their seal and `is` tells of each column that
// it has the value which they give it: a database may not notice a changed byte, and a damaged
// index can lead to the wrong row.
[[nodiscard]] Result<route::RouteInfo> OpenInfo(
    const route::Bytes& info, const route::Bytes& seal,
    const std::function<bool(int column, const SqlValue& value)>& is);

// kInvalidArgument, naming the field, for an info that no route can have.
[[nodiscard]] Result<void> CheckRoute(const route::RouteInfo& info);
// kInvalidArgument or kCorrupt for a piece that no segment can be.
[[nodiscard]] Result<void> CheckSegment(const route::SegmentPiece& piece);

// Of a segment's row, its bytes left out. Part of the stores' format.
[[nodiscard]] route::Digest Seal(const route::SegmentPiece& piece);

using route::Describe;
// "segment 3 of teaching 1f of route .."
[[nodiscard]] std::string Describe(const route::RouteKey& key, SegmentIndex index);
// kCorrupt: the row fails its seal.
[[nodiscard]] tl::unexpected<Error> DamagedRoute(const route::RouteKey& key,
                                                 const std::string& name);
[[nodiscard]] tl::unexpected<Error> DamagedSegment(const route::RouteKey& key, SegmentIndex index);

}  // namespace trailcast::store
