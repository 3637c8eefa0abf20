#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>

#include "services/exchange/route_keeper.h"
#include "services/route/route_query.h"

namespace trailcast::server {

// How long something took, counted by bounds.
class LatencyHistogram {
 public:
  static constexpr std::array kBounds_s = {0.0001, 0.00025, 0.0005, 0.001, 0.0025, 0.005,
                                           0.01,   0.025,   0.05,   0.1,   0.25,   1.0};
  void Note(double seconds);
  // Lines of Prometheus's text format; `labels` as 'kind="name"'.
  [[nodiscard]] std::string Text(const std::string& metric, const std::string& labels) const;

 private:
  std::array<std::uint64_t, kBounds_s.size()> within_{};  // each counts those of the ones before
  std::uint64_t count_ = 0;
  double sum_s_ = 0.0;
};

// By what most a query narrows down: "name", "tag", "place", "view", or "other".
[[nodiscard]] const char* KindOf(const route::RouteQuery& query);

// What a server did and holds, for Prometheus
// (https://prometheus.io/docs/instrumenting/exposition_formats/).
struct Metrics {
  exchange::KeeperCounters keeper;
  std::uint64_t dropped = 0;           // messages out of bounds or unreadable
  std::uint64_t requests_refused = 0;  // too many waited
  struct {
    std::uint64_t segments = 0;  // not taken, or not sent
    std::uint64_t routes = 0;    // announcements that were not taken
    std::uint64_t requests = 0;
  } over_quota{};
  struct {
    std::uint64_t routes_searched = 0;  // that others were looked for near
    std::uint64_t proposed = 0;         // to operators
    std::uint64_t taken = 0;            // without asking
    std::uint64_t crossings = 0;        // that scouts were told of
    std::size_t open = 0;               // proposals that wait for an operator
  } joints{};
  std::size_t routes = 0;   // in the store
  std::size_t backlog = 0;  // segments announced, not durable yet
  std::size_t agents = 0;   // present
  bool store_reachable = true;
  bool on_network = true;
  std::uint64_t network_joins = 0;
  struct {
    std::size_t servers = 0;    // others that were met, and have not said good-bye
    std::size_t same = 0;       // of these, those that are there and hold the same routes
    std::size_t under_way = 0;  // routes that are asked of them
    std::uint64_t asked = 0;    // since the start
  } mirror{};
  std::size_t partial_routes = 0;                   // complete ones that lack segments here
  std::size_t lacking_segments = 0;                 // of these
  std::uint64_t dropped_strays = 0;                 // segments that nobody announced
  std::map<std::string, LatencyHistogram> queries;  // by kind

  [[nodiscard]] std::string Text() const;
};

}  // namespace trailcast::server
