#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "services/console/network_query.h"
#include "services/network/network.h"

namespace trailcast::console {

// What a server lists of its network, a line each (network/words.h), of which a page is shown a
// part: there may be ten thousand routes. What is not understood is left out.
class NetworkList {
 public:
  // Joints, proposed ones, closed and limited parts, narrow places and names shown at once, of each
  // kind.
  static constexpr std::size_t kMostMarks = 2000;

  // `whole`: these are all.
  NetworkList(const std::vector<std::string>& lines, bool whole);

  // What openapi.yaml calls NetworkPart.
  [[nodiscard]] std::string Body(const NetworkQuery& query) const;

 private:
  enum class Kind { kJoint, kProposed, kCondition, kLost, kLane, kName };
  static constexpr auto kKinds = static_cast<std::size_t>(Kind::kName) + 1;
  struct Route {
    std::string name{};
    std::string lower{};  // that is searched in: names of places upon it, too
    std::string line{};
    std::vector<std::size_t> joined{};  // to others
  };
  // With which routes it has to do.
  struct Mark {
    Kind kind = Kind::kJoint;
    std::size_t route = 0;
    std::size_t other = 0;
    std::string line{};
  };

  void TakeJoint(Kind kind, const network::Joint& joint, const std::string& line);
  [[nodiscard]] std::optional<std::size_t> Find(const std::string& route) const;
  [[nodiscard]] std::vector<std::size_t> Matching(const std::string& search) const;
  [[nodiscard]] std::vector<std::size_t> Around(const std::string& route) const;
  [[nodiscard]] std::vector<std::size_t> WithMet(const std::string& route) const;

  std::vector<Route> routes_;  // by name
  std::map<std::string, std::size_t> numbers_;
  std::vector<Mark> marks_;
  std::size_t joints_ = 0;  // those of routes that are no more included
  bool whole_;
};

}  // namespace trailcast::console
