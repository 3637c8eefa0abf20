#include "services/console/site.h"

#include <cmath>
#include <utility>

#include "services/base/angles.h"
#include "services/base/durable_file.h"
#include "services/program/json.h"

namespace trailcast::console {
namespace {

namespace fs = std::filesystem;
using program::Json;
using program::OneLine;

constexpr double kFarthest_m = 1e6;
constexpr double kLeastScale = 0.1;
constexpr double kMostScale = 10.0;
constexpr double kFinestPixel_m = 1e-4;
constexpr double kCoarsestPixel_m = 100.0;
constexpr std::size_t kMostTextBytes = 4U << 20U;

struct PlanFile {
  const char* name;
  const char* type;
  std::string_view begins;
};
// Only pixel pictures are accepted, because a drawing (SVG) from a stranger may be a program.
constexpr PlanFile kPlanFiles[] = {{"plan.png", "image/png", "\x89PNG\r\n\x1a\n"},
                                   {"plan.jpg", "image/jpeg", "\xff\xd8\xff"}};

std::optional<double> NumberIn(const Json& json, const char* field, double least, double most) {
  const auto found = json.find(field);
  if (found == json.end() || !found->is_number()) return std::nullopt;
  const double value = found->get<double>();
  return value >= least && value <= most ? std::optional(value) : std::nullopt;
}

Result<Placement> PlacementOf(const Json& json) {
  if (!json.is_object() || json.size() != 4) {
    return Fail(ErrorCode::kInvalidArgument,
                "a placement is {{\"x_m\": .., \"y_m\": .., \"heading_rad\": .., \"scale\": ..}}");
  }
  const auto x_m = NumberIn(json, "x_m", -kFarthest_m, kFarthest_m);
  const auto y_m = NumberIn(json, "y_m", -kFarthest_m, kFarthest_m);
  const auto heading_rad = NumberIn(json, "heading_rad", -100.0, 100.0);
  const auto scale = NumberIn(json, "scale", kLeastScale, kMostScale);
  if (x_m && y_m && heading_rad && scale) {
    return Placement{*x_m, *y_m, WrapAngle(*heading_rad), *scale};
  }
  return Fail(ErrorCode::kInvalidArgument,
              "'x_m' and 'y_m' are to be metres within {:.0f} of the plan, 'heading_rad' an angle "
              "within 100, 'scale' {} to {}",
              kFarthest_m, kLeastScale, kMostScale);
}

Json ValueOf(const Placement& placement) {
  return {{"x_m", placement.x_m},
          {"y_m", placement.y_m},
          {"heading_rad", placement.heading_rad},
          {"scale", placement.scale}};
}

Json ValueOf(const Placements& placements) {
  Json json = Json::object();
  for (const auto& [route, placement] : placements) json[route.value()] = ValueOf(placement);
  return json;
}

// Returns nothing if there is no such file.
Result<std::optional<std::string>> Contents(const fs::path& file, std::size_t most_bytes) {
  auto bytes = ReadBoundedFile(file, most_bytes);
  if (bytes) return *std::move(bytes);
  if (bytes.error().code == ErrorCode::kNotFound) return std::nullopt;
  return tl::unexpected(bytes.error());
}

template <typename Read>
auto ReadFile(const fs::path& file, const Read& read) -> decltype(read(std::string())) {
  const auto text = Contents(file, kMostTextBytes);
  if (!text) return tl::unexpected(text.error());
  if (!*text) return {};
  auto value = read(**text);
  if (!value) return Wrap(value.error(), file.string());
  return value;
}

}  // namespace

Result<Placement> ReadPlacement(const std::string& body) {
  return PlacementOf(Json::parse(body, nullptr, /*allow_exceptions=*/false));
}

Result<SiteFile> ReadSiteFile(const std::string& text) {
  const Json json = Json::parse(text, nullptr, /*allow_exceptions=*/false);
  const auto wrong = [] {
    return Fail(ErrorCode::kCorrupt,
                "expected {{\"metres_per_pixel\": 0.05}}, and, where north is up, "
                "\"origin\": {{\"longitude_deg\": .., \"latitude_deg\": ..}} of the lower left "
                "corner");
  };
  if (!json.is_object()) return wrong();
  SiteFile site;
  for (const auto& [name, value] : json.items()) {
    if (name == "metres_per_pixel") {
      site.metres_per_pixel = NumberIn(json, "metres_per_pixel", kFinestPixel_m, kCoarsestPixel_m);
      if (!site.metres_per_pixel) return wrong();
    } else if (name == "origin" && value.is_object()) {
      const auto longitude_deg = NumberIn(value, "longitude_deg", -180.0, 180.0);
      const auto latitude_deg = NumberIn(value, "latitude_deg", -85.0, 85.0);
      if (!longitude_deg || !latitude_deg) return wrong();
      site.origin = {*longitude_deg, *latitude_deg};
    } else {
      return wrong();
    }
  }
  return site;
}

Result<Placements> ReadPlacements(const std::string& text) {
  const Json json = Json::parse(text, nullptr, /*allow_exceptions=*/false);
  if (!json.is_object() || json.size() > Site::kMostPlacements) {
    return Fail(ErrorCode::kCorrupt, "expected an object with a placement for each route's id");
  }
  Placements placements;
  for (const auto& [route, value] : json.items()) {
    const auto placement = PlacementOf(value);
    if (!placement || !IsValidName(route)) {
      return Fail(ErrorCode::kCorrupt, "of one of its routes: {}",
                  placement ? "what is no id" : placement.error().message);
    }
    placements.emplace(route, *placement);
  }
  return placements;
}

Result<std::unique_ptr<Site>> Site::Open(const fs::path& folder) {
  std::error_code error;
  if (!fs::is_directory(folder, error)) {
    return Fail(ErrorCode::kNotFound, "there is no folder {}", folder.string());
  }
  std::unique_ptr<Site> site(new Site(folder));
  const auto about = ReadFile(folder / "site.json", ReadSiteFile);
  if (!about) return tl::unexpected(about.error());
  site->origin_ = about->origin;
  auto placements = ReadFile(folder / "placements.json", ReadPlacements);
  if (!placements) return tl::unexpected(placements.error());
  site->placements_ = *std::move(placements);
  for (const PlanFile& file : kPlanFiles) {
    auto bytes = Contents(folder / file.name, kMostPlanBytes);
    if (!bytes) return tl::unexpected(bytes.error());
    if (!*bytes) continue;
    if (!(*bytes)->starts_with(file.begins)) {
      return Fail(ErrorCode::kCorrupt, "{} is no picture of this kind",
                  (folder / file.name).string());
    }
    if (!about->metres_per_pixel) {
      return Fail(ErrorCode::kNotFound,
                  "{} is to say how many metres a pixel of {} is: {{\"metres_per_pixel\": 0.05}}",
                  (folder / "site.json").string(), file.name);
    }
    site->plan_ = {file.type, **std::move(bytes), *about->metres_per_pixel};
    break;
  }
  return site;
}

Result<void> Site::Place(const RouteId& route, const std::optional<Placement>& placement) {
  const std::scoped_lock lock(mutex_);
  Placements changed = placements_;
  changed.erase(route);
  if (placement) changed.emplace(route, *placement);
  if (changed.size() > kMostPlacements) {
    return Fail(ErrorCode::kUnavailable, "a site has room for {} routes", kMostPlacements);
  }
  if (auto written = ReplaceFile(folder_ / "placements.json", program::Indented(ValueOf(changed)));
      !written) {
    return written;
  }
  placements_ = std::move(changed);
  return {};
}

Placements Site::placements() {
  const std::scoped_lock lock(mutex_);
  return placements_;
}

std::string Site::Body() {
  Json plan;
  if (plan_) plan = {{"metres_per_pixel", plan_->metres_per_pixel}};
  Json origin;
  if (origin_) {
    origin = {{"longitude_deg", origin_->longitude_deg}, {"latitude_deg", origin_->latitude_deg}};
  }
  const std::scoped_lock lock(mutex_);
  return OneLine({{"kept", true},
                  {"plan", std::move(plan)},
                  {"origin", std::move(origin)},
                  {"placements", ValueOf(placements_)}});
}

std::string NoSiteBody() {
  return OneLine(
      {{"kept", false}, {"plan", nullptr}, {"origin", nullptr}, {"placements", Json::object()}});
}

}  // namespace trailcast::console
