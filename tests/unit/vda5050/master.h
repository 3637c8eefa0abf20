#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "services/vda5050/protocol.h"
#include "tests/unit/vda5050/json_schema.h"

namespace trailcast::vda5050 {

using nlohmann::json;

// Makes what a fleet manager sends, in both versions.
class Master {
 public:
  explicit Master(Identity identity) : identity_(std::move(identity)) {}

  [[nodiscard]] json Head() const {
    return json::parse(json(Header(identity_, 7, 1'700'000'000'123)).dump());
  }
  // An order over these nodes, of which the first `released` are released, from that sequenceId.
  [[nodiscard]] json Order(const std::string& id, int update, const std::vector<std::string>& nodes,
                           std::size_t released, int sequence = 0) const {
    json order = Head();
    order["orderId"] = id;
    order["orderUpdateId"] = update;
    order["nodes"] = json::array();
    order["edges"] = json::array();
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      order["nodes"].push_back({{"nodeId", nodes[i]},
                                {"sequenceId", sequence + 2 * static_cast<int>(i)},
                                {"released", i < released},
                                {"actions", json::array()}});
      if (i == 0) continue;
      json edge{{"edgeId", nodes[i - 1] + "-" + nodes[i]},
                {"sequenceId", sequence + 2 * static_cast<int>(i) - 1},
                {"released", i < released},
                {"actions", json::array()}};
      if (identity_.version == Version::k2_1) {
        edge["startNodeId"] = nodes[i - 1];
        edge["endNodeId"] = nodes[i];
      }
      order["edges"].push_back(edge);
    }
    return order;
  }
  [[nodiscard]] json Actions(const std::string& type, const std::string& id,
                             const std::string& order = "") const {
    json action{{"actionType", type}, {"actionId", id}, {"blockingType", "NONE"}};
    if (!order.empty()) {
      action["actionParameters"] = json::array({{{"key", "orderId"}, {"value", order}}});
    }
    json actions = Head();
    actions["actions"] = json::array({action});
    return actions;
  }

 private:
  Identity identity_;
};

}  // namespace trailcast::vda5050
