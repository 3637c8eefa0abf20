#pragma once

#include <cstddef>
#include <deque>
#include <map>
#include <optional>
#include <vector>

#include "services/base/result.h"
#include "services/exchange/messages.h"

namespace trailcast::server {

// Returns the member that asks; its processes all count as one.
[[nodiscard]] AgentId MemberOf(const exchange::Message& request);

// Questions about the catalog, the network and missions, edits, and missions wait here for their
// turn. Members of the fleet are served in rotation, each in the order in which it asked, so that
// many or slow requests of one delay neither the others nor the segments. The queue is bounded.
class RequestQueue {
 public:
  static constexpr std::size_t kMostOfAMember = 16;
  static constexpr std::size_t kMost = 2048;  // 20 MB if all of them have a view

  // Adds a CatalogRequest, RouteEditRequest, NetworkRequest, NetworkEdit, MissionRequest or
  // Mission. A repeated request takes the place of the one that waits. kUnavailable has the words
  // for the reply: too many wait.
  [[nodiscard]] Result<void> Add(const exchange::Message& request);
  [[nodiscard]] std::optional<exchange::Message> Next();
  // Takes all missions before their turn, because an immediate command concerns them, too.
  [[nodiscard]] std::vector<mission::Mission> TakeMissions();
  [[nodiscard]] bool empty() const { return size_ == 0; }
  [[nodiscard]] std::size_t size() const { return size_; }

 private:
  std::map<AgentId, std::deque<exchange::Message>> waiting_;  // none of them empty
  std::size_t size_ = 0;
  AgentId served_last_;
};

}  // namespace trailcast::server
