#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "services/base/ids.h"
#include "services/exchange/messages.h"

namespace trailcast::agent {

// What a robot asks servers that does not know where it is: which routes look like what it sees.
class ViewQuestion {
 public:
  static constexpr std::uint32_t kMostRoutes = 3;

  // `number`: of the request, another one each time. `view`: vision::DescribeForQuery.
  ViewQuestion(const AgentId& self, std::uint64_t number, route::View view);

  [[nodiscard]] const exchange::CatalogRequest& request() const { return request_; }
  void Hear(const exchange::Message& message);
  // By the first server that could.
  [[nodiscard]] bool answered() const { return routes_.has_value(); }
  // Names of those that robots follow, the likest first.
  [[nodiscard]] std::vector<std::string> routes() const {
    return routes_.value_or(std::vector<std::string>());
  }

 private:
  exchange::CatalogRequest request_;
  std::optional<std::vector<std::string>> routes_;
};

}  // namespace trailcast::agent
