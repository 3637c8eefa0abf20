#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <vector>

#include "services/base/result.h"
#include "services/route/route.h"
#include "services/store/src/row_values.h"

namespace trailcast::store {

// Binds values from parameter `first` on, and returns the number of the next one.
int BindValues(SQLite::Statement& statement, const std::vector<SqlValue>& values, int first = 1);
void BindBytes(SQLite::Statement& statement, int parameter, const route::Bytes& bytes);
void BindDigest(SQLite::Statement& statement, int parameter, const route::Digest& digest);
void BindKey(SQLite::Statement& statement, const route::RouteKey& key);  // parameters 1 and 2

[[nodiscard]] TeachingId TeachingOf(const SQLite::Column& column);
// Returns no bytes if the column is NULL.
[[nodiscard]] route::Bytes ReadBytes(const SQLite::Column& column);

// Binds parameters in the order of kRouteColumns.
void BindRoute(SQLite::Statement& statement, const route::RouteInfo& info);
// Reads the statement's current row; kCorrupt means that it is damaged.
[[nodiscard]] Result<route::RouteInfo> ReadRoute(const SQLite::Statement& statement);

// These are the columns of table `segment` that ReadSegmentRow reads.
inline constexpr const char* kSegmentContent = "digest, seal, bytes";
// Selects its rows with a digest, which is given once. The index has the digest's beginning.
inline constexpr const char* kOfDigest = "substr(digest, 1, 4) = substr(?1, 1, 4) AND digest = ?1";

// Binds route, teaching, number, digest, seal, bytes. It borrows the piece's bytes until the
// statement is done; without bytes, the row relies on another's.
void BindSegment(SQLite::Statement& statement, const route::SegmentPiece& piece);
// Reads the statement's current row, which was requested with this key and index. It has no bytes
// if it relies on another's. kCorrupt means that it is damaged, or that damage made it match
// another's key. CheckDigest tells whether the bytes match the digest.
[[nodiscard]] Result<route::SegmentPiece> ReadSegmentRow(const SQLite::Statement& statement,
                                                         const route::RouteKey& key,
                                                         SegmentIndex index);

}  // namespace trailcast::store
