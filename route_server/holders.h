#pragma once

#include <map>
#include <set>
#include <vector>

#include "services/exchange/messages.h"

namespace trailcast::server {

// Which agent said last that it holds which revisions. It still does when it is gone from the
// network: switched off, or out of reach.
class Holders {
 public:
  void Note(const exchange::AgentStatus& status);
  // Of the routes given, as many as a reply carries.
  [[nodiscard]] std::vector<exchange::Holding> Of(
      const std::vector<route::RouteInfo>& routes) const;

 private:
  static constexpr std::size_t kMostAgents = 4096;  // strangers can make up names

  std::map<AgentId, std::vector<route::RouteKey>> held_;
  std::map<route::RouteKey, std::set<AgentId>>
      holders_;  // the same, for the catalog's many questions
};

}  // namespace trailcast::server
