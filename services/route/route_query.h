#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "services/route/route.h"
#include "services/route/view.h"

namespace trailcast::route {

// A page of routes is sorted by this. Ties are sorted by key.
enum class RouteOrder : std::uint8_t {
  kNewest = 0,
  kOldest = 1,
  kName = 2,
  kLongest = 3,
  kShortest = 4,
};

struct Surroundings {
  Place middle;
  double radius_m = 0.0;  // above 0

  bool operator==(const Surroundings&) const = default;
};

// This tells which routes are asked for. Empty and zero fields do not narrow the question; all
// others must hold.
struct RouteQuery {
  std::string name{};               // exactly this, or the beginning of an id (LooksLikeId)
  std::string name_prefix{};        // the beginning of the name
  std::vector<std::string> tags{};  // the route has all of them
  std::string scout{};              // exactly this
  std::string camera_prefix{};
  double min_length_m = 0.0;
  double max_length_m = 0.0;
  std::int64_t taught_from_unix_ms = 0;   // at that time or later
  std::int64_t taught_until_unix_ms = 0;  // before that time
  std::optional<RouteState> state{};
  std::optional<Standing> standing{};  // deleted revisions are not found
  std::optional<Surroundings> near{};  // the route begins there; one without a place is not found
  RouteOrder order = RouteOrder::kNewest;
  std::uint32_t page_size = 0;  // 0 leaves it to the server
  std::string cursor{};         // RoutePage::next of the page before; empty for the first page
  View view{};  // some place of the route looks like this; combines with page_size alone

  bool operator==(const RouteQuery&) const = default;
};

// Pages are stable: whatever is stored or deleted meanwhile, no page repeats a route or omits one
// that was there all the time.
struct RoutePage {
  std::vector<RouteInfo> routes{};
  std::uint64_t total = 0;  // matches on all pages
  std::string next{};       // empty on the last page

  bool operator==(const RoutePage&) const = default;
};

}  // namespace trailcast::route
