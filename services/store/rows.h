#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include "services/base/result.h"
#include "services/route/route.h"

namespace trailcast::store {

// Columns of tables `route` and `tombstone`, in the order of BindRoute and ReadRoute.
inline constexpr const char* kRouteColumns =
    "route, revision, name, scout, camera, image_width_px, image_height_px, taught_unix_ms, state, "
    "segment_count, length_m, bytes, manifest_digest, seal, tags, place_frame, place_east, "
    "place_north, description, standing, edition";

// kInvalidArgument, naming the field, for an info that no route can have.
[[nodiscard]] Result<void> CheckRoute(const route::RouteInfo& info);
void BindRoute(SQLite::Statement& statement, const route::RouteInfo& info);
// The statement's current row. kCorrupt if it fails its seal.
[[nodiscard]] Result<route::RouteInfo> ReadRoute(const SQLite::Statement& statement);

void BindKey(SQLite::Statement& statement, const route::RouteKey& key);  // parameters 1 and 2

// Columns of table `segment`, in the order of BindSegment, and those that ReadSegmentRow reads.
inline constexpr const char* kSegmentColumns = "route, revision, number, digest, seal, bytes";
inline constexpr const char* kSegmentContent = "digest, seal, bytes";

// kInvalidArgument or kCorrupt for a piece that no segment can be.
[[nodiscard]] Result<void> CheckSegment(const route::SegmentPiece& piece);
// Borrows the piece's bytes until the statement is done; without bytes it relies on another's.
void BindSegment(SQLite::Statement& statement, const route::SegmentPiece& piece);
void BindDigest(SQLite::Statement& statement, int parameter, const route::Digest& digest);
// The statement's current row, asked for under this key and index; without bytes if it relies on
// another's. kCorrupt if it is damaged, or if damage made it answer to another's name. Whether the
// bytes are those of the digest is for CheckDigest.
[[nodiscard]] Result<route::SegmentPiece> ReadSegmentRow(const SQLite::Statement& statement,
                                                         const route::RouteKey& key,
                                                         SegmentIndex index);

// "route ... revision 2", for messages.
[[nodiscard]] std::string Describe(const route::RouteKey& key);
// "segment 3 of route ... revision 2"
[[nodiscard]] std::string Describe(const route::RouteKey& key, SegmentIndex index);

}  // namespace trailcast::store
