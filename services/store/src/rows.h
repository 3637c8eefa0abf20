#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include "services/base/result.h"
#include "services/route/route.h"
#include "services/store/src/row_values.h"

namespace trailcast::store {

// In the order of kRouteColumns.
void BindRoute(SQLite::Statement& statement, const route::RouteInfo& info);
// The statement's current row. kCorrupt if it fails its seal.
[[nodiscard]] Result<route::RouteInfo> ReadRoute(const SQLite::Statement& statement);
// The same of a row that has the seal of version 4.
[[nodiscard]] Result<route::RouteInfo> ReadRouteOf4(const SQLite::Statement& statement);

[[nodiscard]] TeachingId TeachingOf(const SQLite::Column& column);
void BindKey(SQLite::Statement& statement, const route::RouteKey& key);  // parameters 1 and 2

// Columns of table `segment` that ReadSegmentRow reads.
inline constexpr const char* kSegmentContent = "digest, seal, bytes";

// Route, revision, number, digest, seal, bytes. Borrows the piece's bytes until the statement is
// done; without bytes it relies on another's.
void BindSegment(SQLite::Statement& statement, const route::SegmentPiece& piece);
void BindDigest(SQLite::Statement& statement, int parameter, const route::Digest& digest);
// The statement's current row, asked for under this key and index; without bytes if it relies on
// another's. kCorrupt if it is damaged, or if damage made it answer to another's name. Whether the
// bytes are those of the digest is for CheckDigest.
[[nodiscard]] Result<route::SegmentPiece> ReadSegmentRow(const SQLite::Statement& statement,
                                                         const route::RouteKey& key,
                                                         SegmentIndex index);

}  // namespace trailcast::store
