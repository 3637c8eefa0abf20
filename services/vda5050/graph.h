#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "services/base/result.h"
#include "services/network/network.h"

namespace trailcast::vda5050 {

// The network of routes as nodes of VDA 5050: named places, ends of routes, junctions, and any
// other place ROUTE:METRES. Edges are what leads from one to another.
class Graph {
 public:
  // Reads what a route server lists (network/words.h). Lines that a later version may have, and
  // what is not used, are left out.
  [[nodiscard]] static Result<Graph> Read(const std::vector<std::string>& lines);

  struct Node {
    std::string goal{};  // as missions call it: a place's name, or ROUTE@METRES
    network::Place place{};
  };
  // Finds a node by its id: a place's name, ROUTE:METRES or ROUTE@METRES. kNotFound.
  [[nodiscard]] Result<Node> Find(std::string_view id) const;
  // Returns what network::Network::ShortestWay does.
  [[nodiscard]] Result<network::Way> WayBetween(const network::Place& from,
                                                const network::Place& to) const;
  // Returns whether a robot there stands on the node: no more than kOnNode_m before or beyond it,
  // or on another route where that is joined to the node's.
  [[nodiscard]] bool IsOn(const network::Place& robot, const network::Place& node) const;
  static constexpr double kOnNode_m = 1.0;
  // Returns the id of the nearest named place, end or junction that a robot there stands on.
  [[nodiscard]] std::optional<std::string> NodeAt(const network::Place& robot) const;

 private:
  struct Named {
    std::string id{};
    network::Place place{};
  };
  explicit Graph(network::Network network) : network_(std::move(network)) {}

  network::Network network_;
  std::vector<Named> nodes_;  // named places, then ends and junctions
};

}  // namespace trailcast::vda5050
