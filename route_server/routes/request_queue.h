#pragma once

#include <cstddef>
#include <deque>
#include <map>
#include <optional>
#include <vector>

#include "services/base/result.h"
#include "services/exchange/messages.h"

namespace trailcast::server {

// Tells which member asks; all of its processes are one.
[[nodiscard]] AgentId MemberOf(const exchange::Message& request);

// Questions about the catalog, the network of routes and missions, edits, and the missions that are
// sent wait here for their turn. The members of the fleet are served one after the other, each in
// the order in which it asked, so that one who asks for much, or slowly, delays neither the others
// nor the segments. The queue is bounded.
class RequestQueue {
 public:
  static constexpr std::size_t kMostOfAMember = 16;
  static constexpr std::size_t kMost = 2048;  // 20 MB, if all of them have a view

  // A CatalogRequest, RouteEditRequest, NetworkRequest, NetworkEdit, MissionRequest or Mission. The
  // same that waits already, asked again, takes its place. kUnavailable, in words for the reply:
  // too many wait.
  [[nodiscard]] Result<void> Add(const exchange::Message& request);
  [[nodiscard]] std::optional<exchange::Message> Next();
  // Takes all missions before their turn: what is told to robots now is about them, too.
  [[nodiscard]] std::vector<mission::Mission> TakeMissions();
  [[nodiscard]] bool empty() const { return size_ == 0; }
  [[nodiscard]] std::size_t size() const { return size_; }

 private:
  std::map<AgentId, std::deque<exchange::Message>> waiting_;  // none of them empty
  std::size_t size_ = 0;
  AgentId served_last_;
};

}  // namespace trailcast::server
