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

// This is where a route lies on a site: its beginning, in metres to the right and up from the lower
// left corner of the floor plan; the heading there, counter-clockwise from rightwards; and the
// factor by which the scout's metres are drawn longer.
struct Placement {
  double x_m = 0.0;
  double y_m = 0.0;
  double heading_rad = 0.0;
  double scale = 1.0;

  bool operator==(const Placement&) const = default;
};

// Reads a request's body. Fails with kInvalidArgument.
[[nodiscard]] Result<Placement> ReadPlacement(const std::string& body);

// This is the place on the globe of the lower left corner of a plan whose up is north.
struct Origin {
  double longitude_deg = 0.0;
  double latitude_deg = 0.0;

  bool operator==(const Origin&) const = default;
};
struct SiteFile {
  std::optional<double> metres_per_pixel{};
  std::optional<Origin> origin{};
};
// These read site.json and placements.json. They fail with kCorrupt.
[[nodiscard]] Result<SiteFile> ReadSiteFile(const std::string& text);
using Placements = std::map<RouteId, Placement>;
[[nodiscard]] Result<Placements> ReadPlacements(const std::string& text);

// This is a folder with a floor plan (plan.png or plan.jpg, and in site.json its metres for each
// pixel) and the places on it at which people put routes (placements.json, written here). It may be
// used from any thread.
class Site {
 public:
  static constexpr std::size_t kMostPlacements = 10'000;
  static constexpr std::size_t kMostPlanBytes = 32U << 20U;

  // Fails with kNotFound without the folder, and with kCorrupt, which names the file, for wrong
  // content.
  [[nodiscard]] static Result<std::unique_ptr<Site>> Open(const std::filesystem::path& folder);

  struct Plan {
    const char* type = "";
    std::string bytes{};
    double metres_per_pixel = 0.0;
  };
  [[nodiscard]] const std::optional<Plan>& plan() const { return plan_; }

  // Places a route, or removes it from the site if there is no placement. It is on the disk when
  // this returns.
  [[nodiscard]] Result<void> Place(const RouteId& route, const std::optional<Placement>& placement);
  // Returns where the floor plan's lower left corner is, if its site.json says so.
  [[nodiscard]] const std::optional<Origin>& origin() const { return origin_; }
  [[nodiscard]] Placements placements();
  // Returns openapi.yaml's Site.
  [[nodiscard]] std::string Body();

 private:
  explicit Site(std::filesystem::path folder) : folder_(std::move(folder)) {}

  std::filesystem::path folder_;
  std::optional<Plan> plan_;
  std::optional<Origin> origin_;

  std::mutex mutex_;  // guards what follows, and its file
  Placements placements_;
};

// Returns the body for a console without a site.
[[nodiscard]] std::string NoSiteBody();

}  // namespace trailcast::console
