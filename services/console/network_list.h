#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "services/console/network_query.h"
#include "services/network/network.h"

namespace trailcast::console {

// This is a server's list of its network (network/words.h), a part of which is shown, because there
// may be ten thousand routes. Lines that are not understood are left out.
class NetworkList {
 public:
  // So many junctions, proposed ones, closed and limited parts, narrow places and names are shown
  // at once, of each kind.
  static constexpr std::size_t kMostMarks = 2000;

  // The `lines` are all of the network if they are `whole`.
  NetworkList(const std::vector<std::string>& lines, bool whole);

  // Returns openapi.yaml's NetworkPart.
  [[nodiscard]] std::string Body(const NetworkQuery& query) const;

 private:
  enum class Kind { kJunction, kProposed, kCondition, kLost, kLane, kName };
  static constexpr auto kKinds = static_cast<std::size_t>(Kind::kName) + 1;
  struct Route {
    std::string name{};
    std::string lower{};  // searched text, including names of places on it
    std::string line{};
    std::vector<std::size_t> joined{};  // the routes that it is joined to
  };
  // This is one line of the network, and the routes that it is about.
  struct Mark {
    Kind kind = Kind::kJunction;
    std::size_t route = 0;
    std::size_t other = 0;
    std::string line{};
  };

  void TakeJunction(Kind kind, const network::Junction& junction, const std::string& line);
  [[nodiscard]] std::optional<std::size_t> Find(const std::string& route) const;
  [[nodiscard]] std::vector<std::size_t> Matching(const std::string& search) const;
  [[nodiscard]] std::vector<std::size_t> Around(const std::string& route) const;
  [[nodiscard]] std::vector<std::size_t> WithMet(const std::string& route) const;

  std::vector<Route> routes_;  // sorted by name
  std::map<std::string, std::size_t> numbers_;
  std::vector<Mark> marks_;
  std::vector<std::string> of_fleet_;  // when robots charge, and which ones do
  std::size_t junctions_ =
      0;  // number of junctions, including those of routes that no longer exist
  bool whole_;
};

}  // namespace trailcast::console
