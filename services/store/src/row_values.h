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

// Added to lower-case hexadecimal digits, this comes after everything that begins with them.
inline constexpr const char* kAfterHexDigits = "g";

// The values of rows, whatever database holds them.

// the first is NULL
using SqlValue = std::variant<std::monostate, std::string, std::int64_t, double>;

// These are the columns of tables `route` and `tombstone`: those by which rows are found and
// sorted; then the route's description in the route format, from which all others are made; then
// its seal.
inline constexpr const char* kRouteColumns =
    "route, teaching, revision, name, scout, camera, taught_unix_ms, state, segment_count, "
    "length_m, standing, place_frame, place_east, place_north, info, seal";
inline constexpr int kFoundByCount = 14;
inline constexpr int kRouteColumnCount = kFoundByCount + 2;

// Returns "?,?,?": parameters for so many columns.
[[nodiscard]] std::string Marks(int count);

// Returns the first kFoundByCount of them.
[[nodiscard]] std::vector<SqlValue> FoundBy(const route::RouteInfo& info);
// Returns the description of a row of kRouteColumns if its bytes match their seal, and `is`
// confirms that each column has the value that they give it. A database may not notice a changed
// byte, and a damaged index can lead to the wrong row.
[[nodiscard]] Result<route::RouteInfo> OpenInfo(
    const route::Bytes& info, const route::Bytes& seal,
    const std::function<bool(int column, const SqlValue& value)>& is);

// kInvalidArgument names the field that no route can have.
[[nodiscard]] Result<void> CheckRoute(const route::RouteInfo& info);
// kInvalidArgument or kCorrupt means that no segment can have the piece.
[[nodiscard]] Result<void> CheckSegment(const route::SegmentPiece& piece);

// Returns the seal of a segment's row without its bytes. It is part of the stores' format.
[[nodiscard]] route::Digest Seal(const route::SegmentPiece& piece);

using route::Describe;
// Returns "segment 3 of teaching 1f of route ..".
[[nodiscard]] std::string Describe(const route::RouteKey& key, SegmentIndex index);
// Returns kCorrupt for a row that does not match its seal.
[[nodiscard]] tl::unexpected<Error> DamagedRoute(const route::RouteKey& key,
                                                 const std::string& name);
[[nodiscard]] tl::unexpected<Error> DamagedSegment(const route::RouteKey& key, SegmentIndex index);

}  // namespace trailcast::store
