#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <vector>

#include "services/base/result.h"
#include "services/route/route.h"
#include "services/store/src/row_values.h"

namespace trailcast::store {

// From parameter `first` on; the number of the next one.
int BindValues(SQLite::Statement& statement, const std::vector<SqlValue>& values, int first = 1);
void BindBytes(SQLite::Statement& statement, int parameter, const route::Bytes& bytes);
void BindDigest(SQLite::Statement& statement, int parameter, const route::Digest& digest);
void BindKey(SQLite::Statement& statement, const route::RouteKey& key);  // parameters 1 and 2

[[nodiscard]] TeachingId TeachingOf(const SQLite::Column& column);
// None if the column is NULL.
[[nodiscard]] route::Bytes ReadBytes(const SQLite::Column& column);

// Parameters in the order of kRouteColumns.
void BindRoute(SQLite::Statement& statement, const route::RouteInfo& info);
// The statement's current row. kCorrupt if it is damaged.
[[nodiscard]] Result<route::RouteInfo> ReadRoute(const SQLite::Statement& statement);

// Columns of table `segment` that ReadSegmentRow reads.
inline constexpr const char* kSegmentContent = "digest, seal, bytes";
// Which of its rows have a digest, given once: the index has the beginning of it.
inline constexpr const char* kOfDigest = "substr(digest, 1, 4) = substr(?1, 1, 4) AND digest = ?1";

// Route, teaching, number, digest, seal, bytes. Borrows the piece's bytes until the statement is
// done; without bytes it relies on another's.
void BindSegment(SQLite::Statement& statement, const route::SegmentPiece& piece);
// The statement's current row, asked for under this key and index; without bytes if it relies on
// another's. kCorrupt if it is damaged, or if damage made it answer to another's name. Whether the
// bytes are those of the digest is for CheckDigest.
[[nodiscard]] Result<route::SegmentPiece> ReadSegmentRow(const SQLite::Statement& statement,
                                                         const route::RouteKey& key,
                                                         SegmentIndex index);

}  // namespace trailcast::store
