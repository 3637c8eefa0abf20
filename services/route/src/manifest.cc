#include "services/route/manifest.h"

#include <cassert>
#include <utility>

#include "services/route/digest.h"

namespace trailcast::route {

RouteBuilder::RouteBuilder(RouteInfo info) : info_(std::move(info)) {
  info_.state = RouteState::kTeaching;
  info_.cut_off = false;
  info_.segment_count = 0;
  info_.length_m = 0.0;
  info_.bytes = 0;
  info_.manifest_digest = ManifestDigest({});
}

SegmentPiece RouteBuilder::Add(const Segment& segment) {
  assert(info_.state == RouteState::kTeaching);
  assert(segment.index.value() == info_.segment_count);
  SegmentPiece piece = MakePiece(info_.key, segment);
  Add(piece, segment.length_m);
  return piece;
}

void RouteBuilder::Add(const SegmentPiece& piece, double length_m) {
  assert(piece.index.value() == info_.segment_count);
  digests_.push_back(piece.digest);
  info_.segment_count += 1;
  info_.length_m += length_m;
  info_.bytes += piece.bytes.size();
  info_.manifest_digest = ManifestDigest(digests_);
}

}  // namespace trailcast::route
