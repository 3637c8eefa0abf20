#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "services/base/ids.h"
#include "services/exchange/messages.h"

namespace trailcast::agent {

// The question to servers of a robot that does not know where it is: which routes resemble its
// view?
class ViewQuestion {
 public:
  static constexpr std::uint32_t kMostRoutes = 3;

  // `number` is the request's, a new one each time; `view` is from vision::DescribeForQuery.
  ViewQuestion(const AgentId& self, std::uint64_t number, route::View view);

  [[nodiscard]] const exchange::CatalogRequest& request() const { return request_; }
  void Hear(const exchange::Message& message);
  // Says whether a server has answered; the first answer counts.
  [[nodiscard]] bool answered() const { return routes_.has_value(); }
  // Returns the names of routes that robots follow, the most similar first.
  [[nodiscard]] std::vector<std::string> routes() const {
    return routes_.value_or(std::vector<std::string>());
  }

 private:
  exchange::CatalogRequest request_;
  std::optional<std::vector<std::string>> routes_;
};

}  // namespace trailcast::agent
