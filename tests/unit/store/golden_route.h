#pragma once

#include "tests/support/taught_route.h"

namespace trailcast::store {

// What the golden stores hold, apart from that of version 4: a route with labels, cut off, of whose
// two segments the first is receipted, and a tombstone.
[[nodiscard]] inline test::TaughtRoute GoldenRoute() {
  test::TaughtRoute taught = test::TeachSamples(2);
  taught.info.standing = route::Standing::kActive;
  taught.info.edition = 3;
  taught.info.description = "past the greenhouse";
  taught.info.cut_off = true;
  return taught;
}

[[nodiscard]] inline route::RouteInfo GoldenTombstone() {
  route::RouteInfo info = GoldenRoute().info;
  info.key.teaching = TeachingId(1);
  info.revision = RevisionNumber(1);
  info.standing = route::Standing::kDeleted;
  info.edition = 1;
  return info;
}

}  // namespace trailcast::store
