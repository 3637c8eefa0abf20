#include "services/route/info_codec.h"

#include <algorithm>
#include <cassert>
#include <limits>

#include "idl/route.pb.h"
#include "services/route/bounds.h"

namespace trailcast::route {
namespace {

// A value that does not fit becomes the largest that does. No route within bounds has that.
template <typename Narrow>
Narrow Narrowed(std::uint32_t value) {
  return static_cast<Narrow>(
      std::min(value, static_cast<std::uint32_t>(std::numeric_limits<Narrow>::max())));
}

Place ReadPlace(const format::v1::Place& in) {
  return {static_cast<Place::Frame>(Narrowed<std::uint8_t>(in.frame())), in.x(), in.y()};
}

}  // namespace

Bytes EncodeInfo(const RouteInfo& info) {
  format::v1::Route out;
  out.set_route(info.key.route.value());
  // It is left out where it equals the revision's number, as in files from before it existed.
  if (info.key.teaching.value() != info.revision.value()) {
    out.set_teaching(info.key.teaching.value());
  }
  out.set_revision(info.revision.value());
  out.set_cut_off(info.cut_off);
  out.set_name(info.name);
  out.set_scout(info.scout.value());
  out.set_camera(info.camera);
  out.set_image_width_px(static_cast<std::uint32_t>(info.image_width_px));
  out.set_image_height_px(static_cast<std::uint32_t>(info.image_height_px));
  out.set_taught_unix_ms(info.taught_unix_ms);
  out.set_segment_count(info.segment_count);
  out.set_length_m(info.length_m);
  out.set_bytes(info.bytes);
  out.set_manifest_digest(info.manifest_digest.data(), info.manifest_digest.size());
  for (const std::string& tag : info.tags) out.add_tags(tag);
  if (info.place) {
    out.mutable_place()->set_frame(static_cast<std::uint32_t>(info.place->frame));
    out.mutable_place()->set_x(info.place->x);
    out.mutable_place()->set_y(info.place->y);
  }
  out.set_description(info.description);
  out.set_being_taught(info.state == RouteState::kTeaching);
  out.set_standing(static_cast<std::uint32_t>(info.standing));
  out.set_edition(info.edition);
  out.set_to_review(info.to_review);
  out.set_refreshes(info.refreshes.value());
  Bytes bytes(out.ByteSizeLong());
  [[maybe_unused]] const bool fits =
      out.SerializeToArray(bytes.data(), static_cast<int>(bytes.size()));
  assert(fits);
  return bytes;
}

Result<RouteInfo> DecodeInfo(std::span<const std::uint8_t> bytes) {
  if (bytes.size() > kMaxInfoBytes) {
    return Fail(ErrorCode::kCorrupt, "a route's description of {} bytes is larger than {}",
                bytes.size(), kMaxInfoBytes);
  }
  format::v1::Route in;
  if (!in.ParseFromArray(bytes.data(), static_cast<int>(bytes.size()))) {
    return Fail(ErrorCode::kCorrupt, "{} bytes are no route's description", bytes.size());
  }
  RouteInfo info;
  if (in.manifest_digest().size() != info.manifest_digest.size()) {
    return Fail(ErrorCode::kCorrupt, "a route's manifest digest has {} bytes, expected {}",
                in.manifest_digest().size(), info.manifest_digest.size());
  }
  // Before teachings had an identity of their own, the revision's number identified them.
  const std::uint64_t teaching = in.teaching() == 0 ? in.revision() : in.teaching();
  info.key = {RouteId(in.route()), TeachingId(teaching)};
  info.revision = RevisionNumber(in.revision());
  info.cut_off = in.cut_off();
  info.name = in.name();
  info.scout = AgentId(in.scout());
  info.camera = in.camera();
  info.image_width_px = Narrowed<int>(in.image_width_px());
  info.image_height_px = Narrowed<int>(in.image_height_px());
  info.taught_unix_ms = in.taught_unix_ms();
  info.state = in.being_taught() ? RouteState::kTeaching : RouteState::kComplete;
  info.segment_count = in.segment_count();
  info.length_m = in.length_m();
  info.bytes = in.bytes();
  std::copy(in.manifest_digest().begin(), in.manifest_digest().end(), info.manifest_digest.begin());
  info.tags.assign(in.tags().begin(), in.tags().end());
  info.description = in.description();
  info.standing = static_cast<Standing>(Narrowed<std::uint8_t>(in.standing()));
  info.edition = in.edition();
  info.to_review = in.to_review();
  info.refreshes = RevisionNumber(in.refreshes());
  if (in.has_place()) info.place = ReadPlace(in.place());
  if (const auto possible = CheckInfo(info); !possible) {
    return Fail(ErrorCode::kCorrupt, "{}", possible.error().message);
  }
  return info;
}

}  // namespace trailcast::route
