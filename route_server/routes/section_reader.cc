#include "route_server/routes/section_reader.h"

#include <algorithm>
#include <utility>

#include "route_server/routes/followable.h"
#include "services/route/codec.h"

namespace trailcast::server {

Result<route::Segment> ReadSegment(store::RouteStore& store, const route::RouteKey& key,
                                   SegmentIndex index) {
  const auto piece = store.ReadSegment(key, index);
  if (!piece) return tl::unexpected(piece.error());
  auto segment = route::Decode(piece->bytes);
  if (segment) segment->index = index;
  return segment;
}

Result<std::optional<route::RouteInfo>> FindJoinable(store::RouteStore& store,
                                                     const route::RouteKey& key) {
  auto info = store.FindRoute(key);
  if (info && *info && !IsJoinable(**info)) return std::nullopt;
  return info;
}

SectionReader::SectionReader(route::RouteInfo info, SegmentIndex first, SegmentIndex last)
    : info_(std::move(info)),
      first_(first.value()),
      end_(std::min({last.value() + 1, info_.segment_count, first.value() + kMost})) {}

Result<bool> SectionReader::Step(store::RouteStore& store) {
  if (next_ >= end_) return true;
  const auto segment = ReadSegment(store, info_.key, SegmentIndex(next_));
  if (!segment) return tl::unexpected(segment.error());
  if (next_ >= first_) {
    if (!views_) views_ = std::make_shared<junctions::RouteViews>(info_.image_width_px, along_m_);
    views_->Add(*segment);
  }
  along_m_ += segment->length_m;
  return ++next_ >= end_;
}

}  // namespace trailcast::server
