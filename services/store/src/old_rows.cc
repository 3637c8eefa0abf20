#include "services/store/src/old_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "services/route/digest.h"

namespace trailcast::store {
namespace {

std::string Sealed(const route::RouteInfo& info, OldSeal seal) {
  std::string text = fmt::format(
      "{}\n{}\n{}\n{}\n{}\n{}\n{}\n{}\n{}\n{}\n{:a}\n{}\n{}\n", info.key.route.value(),
      info.key.teaching.value(), info.name, info.scout.value(), info.camera, info.image_width_px,
      info.image_height_px, info.taught_unix_ms, static_cast<int>(info.state), info.segment_count,
      info.length_m, info.bytes, route::ToHex(info.manifest_digest));
  for (const std::string& tag : info.tags) text += fmt::format("tag {}\n", tag);
  if (info.place) {
    text += fmt::format("place {} {:a} {:a}\n", static_cast<int>(info.place->frame), info.place->x,
                        info.place->y);
  }
  if (seal == OldSeal::kWithoutLabels) return text;
  return text + fmt::format("labels {} {} {} {}\n{}\n", info.revision.value(), info.cut_off,
                            static_cast<int>(info.standing), info.edition, info.description);
}

}  // namespace

std::string OldColumns(const char* teaching, const char* cut_off) {
  return fmt::format(
      "route, {}, name, scout, camera, image_width_px, image_height_px, taught_unix_ms, state, "
      "segment_count, length_m, bytes, manifest_digest, seal, tags, place_frame, place_east, "
      "place_north, description, standing, edition, revision, {}",
      teaching, cut_off);
}

OldRoute ReadOldRow(const OldRow& row, OldSeal seal) {
  route::RouteInfo info;
  info.key = {RouteId(row.Text(0)), TeachingId(static_cast<std::uint64_t>(row.Number(1)))};
  info.name = row.Text(2);
  info.scout = AgentId(row.Text(3));
  info.camera = row.Text(4);
  info.image_width_px = static_cast<int>(row.Number(5));
  info.image_height_px = static_cast<int>(row.Number(6));
  info.taught_unix_ms = row.Number(7);
  info.state = row.Number(8) == 0 ? route::RouteState::kTeaching : route::RouteState::kComplete;
  info.segment_count = static_cast<std::uint32_t>(row.Number(9));
  info.length_m = row.Real(10);
  info.bytes = static_cast<std::uint64_t>(row.Number(11));
  const route::Bytes manifest = row.Bytes(12);
  std::copy_n(manifest.begin(), std::min(manifest.size(), info.manifest_digest.size()),
              info.manifest_digest.begin());
  std::istringstream tags(row.Text(14));
  for (std::string tag; tags >> tag;) info.tags.push_back(tag);
  if (!row.IsNull(15)) {
    info.place = {static_cast<route::Place::Frame>(row.Number(15)), row.Real(16), row.Real(17)};
  }
  info.description = row.Text(18);
  info.standing = static_cast<route::Standing>(row.Number(19));
  info.edition = static_cast<std::uint32_t>(row.Number(20));
  info.revision = RevisionNumber(static_cast<std::uint32_t>(row.Number(21)));
  info.cut_off = row.Number(22) != 0;
  const std::string text = Sealed(info, seal);
  const route::Digest expected =
      route::Sha256({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
  const route::Bytes found = row.Bytes(13);
  return {info, std::equal(found.begin(), found.end(), expected.begin(), expected.end())};
}

}  // namespace trailcast::store
