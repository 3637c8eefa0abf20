#pragma once

#include <string>
#include <vector>

#include "services/base/result.h"
#include "services/route/labels.h"
#include "services/route/route.h"

namespace trailcast::store {

// What rows are made of, whatever database holds them.

// Columns of tables `route` and `tombstone`.
inline constexpr const char* kRouteColumns =
    "route, teaching, name, scout, camera, image_width_px, image_height_px, taught_unix_ms, state, "
    "segment_count, length_m, bytes, manifest_digest, seal, tags, place_frame, place_east, "
    "place_north, description, standing, edition, revision, cut_off";
inline constexpr int kRouteColumnCount = 23;

// kInvalidArgument, naming the field, for an info that no route can have.
[[nodiscard]] Result<void> CheckRoute(const route::RouteInfo& info);
// kInvalidArgument or kCorrupt for a piece that no segment can be.
[[nodiscard]] Result<void> CheckSegment(const route::SegmentPiece& piece);

// Of a row's other columns: a database may not notice a changed byte, and a damaged index can lead
// to the wrong row. Part of the stores' format.
[[nodiscard]] route::Digest Seal(const route::RouteInfo& info);
// A route's in stores of version 4 and before, which left its labels out.
[[nodiscard]] route::Digest SealBefore5(const route::RouteInfo& info);
[[nodiscard]] route::Digest Seal(const route::SegmentPiece& piece);  // its bytes left out

// As text they are one column; route_tag, by which routes are found, is made from it.
[[nodiscard]] std::string JoinTags(const std::vector<std::string>& tags);
[[nodiscard]] std::vector<std::string> SplitTags(const std::string& joined);

using route::Describe;
// "segment 3 of teaching 1f of route .."
[[nodiscard]] std::string Describe(const route::RouteKey& key, SegmentIndex index);
// kCorrupt: the row fails its seal.
[[nodiscard]] tl::unexpected<Error> DamagedRoute(const route::RouteInfo& info);
[[nodiscard]] tl::unexpected<Error> DamagedSegment(const route::RouteKey& key, SegmentIndex index);

}  // namespace trailcast::store
