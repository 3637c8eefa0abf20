#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "services/base/ids.h"
#include "services/base/result.h"

namespace trailcast::console {

// Where a route lies on a site: its beginning, in metres to the right and up from the lower left
// corner of the floor plan; the heading there, counter-clockwise from rightwards; and how much
// longer the scout's metres are drawn.
struct Placement {
  double x_m = 0.0;
  double y_m = 0.0;
  double heading_rad = 0.0;
  double scale = 1.0;

  bool operator==(const Placement&) const = default;
};

// A request's body. kInvalidArgument.
[[nodiscard]] Result<Placement> ReadPlacement(const std::string& body);

// The whole world's place of the lower left corner of a plan whose up is north.
struct Origin {
  double longitude_deg = 0.0;
  double latitude_deg = 0.0;

  bool operator==(const Origin&) const = default;
};
struct SiteFile {
  std::optional<double> metres_per_pixel{};
  std::optional<Origin> origin{};
};
// site.json, and placements.json. kCorrupt.
[[nodiscard]] Result<SiteFile> ReadSiteFile(const std::string& text);
using Placements = std::map<RouteId, Placement>;
[[nodiscard]] Result<Placements> ReadPlacements(const std::string& text);

// A folder with a floor plan (plan.png or plan.jpg, and in site.json how many metres a pixel is)
// and where people have put routes upon it (placements.json, written here). May be used from any
// thread.
class Site {
 public:
  static constexpr std::size_t kMostPlacements = 10'000;
  static constexpr std::size_t kMostPlanBytes = 32U << 20U;

  // kNotFound without the folder; kCorrupt, naming the file, for what is none of this.
  [[nodiscard]] static Result<std::unique_ptr<Site>> Open(const std::filesystem::path& folder);

  struct Plan {
    const char* type = "";
    std::string bytes{};
    double metres_per_pixel = 0.0;
  };
  [[nodiscard]] const std::optional<Plan>& plan() const { return plan_; }

  // On the disk when it returns; nothing: the route is taken from the site.
  [[nodiscard]] Result<void> Place(const RouteId& route, const std::optional<Placement>& placement);
  // Returns where the floor plan's lower left corner is, if its site.json says so.
  [[nodiscard]] const std::optional<Origin>& origin() const { return origin_; }
  [[nodiscard]] Placements placements();
  // As openapi.yaml's Site.
  [[nodiscard]] std::string Body();

 private:
  explicit Site(std::filesystem::path folder) : folder_(std::move(folder)) {}

  std::filesystem::path folder_;
  std::optional<Plan> plan_;
  std::optional<Origin> origin_;

  std::mutex mutex_;  // guards what follows, and its file
  Placements placements_;
};

// Of a console without one.
[[nodiscard]] std::string NoSiteBody();

}  // namespace trailcast::console
