#include "services/fleet/routes/route_summary.h"

#include <fmt/ranges.h>

#include "services/base/hex.h"
#include "services/base/unix_time.h"
#include "services/fleet/routes/catalog_client.h"
#include "services/program/json.h"
#include "services/route/digest.h"

namespace trailcast::fleet {
namespace {

std::string PlaceText(const route::Place& place) {
  if (place.frame == route::Place::Frame::kWgs84) {
    return fmt::format("{} N, {} E (WGS 84)", place.y, place.x);
  }
  return fmt::format("x {} m, y {} m (site)", place.x, place.y);
}

}  // namespace

std::string LengthText(const route::RouteInfo& info) {
  return info.length_m > 0.0 ? fmt::format("{:.1f} m", info.length_m) : "of unknown length";
}

std::string FileText(const std::string& path, const archive::RouteFile& file) {
  const route::RouteInfo& info = file.info();
  std::string text = fmt::format(
      "{} is whole\n"
      "  route     {} revision {}, id {}\n"
      "  taught    {} by {} with {}, {} x {}\n"
      "  size      {} segments, {}, {} bytes of {}\n"
      "  manifest  {}\n",
      path, info.name, info.revision.value(), info.key.route.value(), DateText(info.taught_unix_ms),
      info.scout.value(), info.camera, info.image_width_px, info.image_height_px,
      info.segment_count, LengthText(info), info.bytes, file.file_bytes(),
      ToHex(info.manifest_digest));
  if (!info.tags.empty()) text += fmt::format("  tags      {}\n", fmt::join(info.tags, " "));
  if (info.place) text += fmt::format("  begins    {}\n", PlaceText(*info.place));
  return text;
}

program::Json FileJson(const std::string& path, const Result<archive::RouteFile>& file) {
  if (!file) return {{"file", path}, {"whole", false}, {"error", file.error().message}};
  return {{"file", path},
          {"whole", true},
          {"file_bytes", file->file_bytes()},
          {"route", RouteJson(file->info())}};
}

}  // namespace trailcast::fleet
