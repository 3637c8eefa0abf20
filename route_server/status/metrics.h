#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>

#include "services/exchange/route_keeper.h"
#include "services/route/route_query.h"

namespace trailcast::server {

// A histogram of durations.
class LatencyHistogram {
 public:
  static constexpr std::array kBounds_s = {0.0001, 0.00025, 0.0005, 0.001, 0.0025, 0.005,
                                           0.01,   0.025,   0.05,   0.1,   0.25,   1.0};
  void Note(double seconds);
  // Returns lines of Prometheus's text format; `labels` are as in 'kind="name"'.
  [[nodiscard]] std::string Text(const std::string& metric, const std::string& labels) const;

 private:
  std::array<std::uint64_t, kBounds_s.size()> within_{};  // each count includes those before it
  std::uint64_t count_ = 0;
  double sum_s_ = 0.0;
};

// Returns the query's most selective part: "name", "tag", "place", "view", or "other".
[[nodiscard]] const char* KindOf(const route::RouteQuery& query);

// A server's counters for Prometheus
// (https://prometheus.io/docs/instrumenting/exposition_formats/).
struct Metrics {
  exchange::KeeperCounters keeper;
  std::uint64_t dropped = 0;           // messages out of bounds or unreadable
  std::uint64_t requests_refused = 0;  // because too many waited
  struct {
    std::uint64_t segments = 0;  // not taken, or not sent
    std::uint64_t routes = 0;    // announcements that were not taken
    std::uint64_t requests = 0;
  } over_quota{};
  struct {
    std::uint64_t routes_searched = 0;  // for which others nearby were sought
    std::uint64_t proposed = 0;         // to operators
    std::uint64_t taken = 0;            // without asking
    std::uint64_t crossings = 0;        // reported to scouts
    std::size_t open = 0;               // proposals that await an operator
  } junctions{};
  std::size_t routes = 0;   // in the store
  std::size_t backlog = 0;  // segments announced, but not on disk yet
  std::size_t agents = 0;   // present
  bool store_reachable = true;
  bool on_network = true;
  std::uint64_t network_joins = 0;
  struct {
    std::size_t servers = 0;    // other servers that were met and have not left
    std::size_t same = 0;       // of these, those that are there and hold the same routes
    std::size_t under_way = 0;  // routes requested from them
    std::uint64_t asked = 0;    // since the start
  } mirror{};
  std::size_t partial_routes = 0;                   // complete ones that lack segments here
  std::size_t lacking_segments = 0;                 // missing from these
  std::uint64_t dropped_orphans = 0;                // orphaned segments
  std::map<std::string, LatencyHistogram> queries;  // by kind

  [[nodiscard]] std::string Text() const;
};

}  // namespace trailcast::server
