#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "services/route/route.h"
#include "services/route/view.h"

namespace trailcast::route {

// What a page of routes is sorted by; ties by key.
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

// Which routes are asked for. What is empty or zero does not narrow it down; the rest must all
// hold.
struct RouteQuery {
  std::string name{};               // exactly this, or an id that begins so (LooksLikeId)
  std::string name_prefix{};        // begins with this
  std::vector<std::string> tags{};  // has all of these
  std::string scout{};              // exactly this
  std::string camera_prefix{};
  double min_length_m = 0.0;
  double max_length_m = 0.0;
  std::int64_t taught_from_unix_ms = 0;   // then or later
  std::int64_t taught_until_unix_ms = 0;  // before
  std::optional<RouteState> state{};
  std::optional<Standing> standing{};  // deleted revisions are not found
  std::optional<Surroundings> near{};  // begins there; without a place of its own: not found
  RouteOrder order = RouteOrder::kNewest;
  std::uint32_t page_size = 0;  // 0: as many as the server likes
  std::string cursor{};         // RoutePage::next of the page before; empty: the first page
  View view{};                  // looks like this somewhere; with nothing else but page_size

  bool operator==(const RouteQuery&) const = default;
};

// Pages are stable: what is stored or deleted meanwhile never makes a page repeat a route or skip
// one that was there all the time.
struct RoutePage {
  std::vector<RouteInfo> routes{};
  std::uint64_t total = 0;  // that match, on all pages
  std::string next{};       // empty: this is the last page

  bool operator==(const RoutePage&) const = default;
};

}  // namespace trailcast::route
