#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "services/exchange/messages.h"
#include "services/network/changes.h"
#include "services/records/history_store.h"
#include "services/store/route_store.h"

namespace trailcast::server {

// Records changes of routes and of the network, with their authors. It compares a revision with
// what was last noted, so that repeated news is none. It has no clock of its own, and uses no
// robot's.
class History {
 public:
  // `routes` must outlive it. Nothing is recorded of what existed before a new file was made.
  [[nodiscard]] static Result<std::unique_ptr<History>> Open(
      AgentId server, std::unique_ptr<store::HistoryStore> store, store::RouteStore& routes,
      std::int64_t now_unix_ms);

  // Notes revisions as they are. `by` is who made them so; it is empty if that is not known.
  [[nodiscard]] Result<void> Note(std::span<const route::RouteInfo> infos, const std::string& by,
                                  std::int64_t now_unix_ms);
  // Notes these as they are stored.
  [[nodiscard]] Result<void> NoteStored(std::span<const route::RouteKey> keys,
                                        const std::string& by, std::int64_t now_unix_ms);
  // Adds changes of the network.
  [[nodiscard]] Result<void> Add(std::span<const network::Change> changes) {
    return changes.empty() ? Result<void>() : store_->Note(changes, {});
  }

  // Answers "changes since .." (network/changes.h).
  [[nodiscard]] exchange::NetworkReply Answer(const exchange::NetworkRequest& request,
                                              std::int64_t since_unix_ms, std::int64_t now_unix_ms);

 private:
  History(AgentId server, std::unique_ptr<store::HistoryStore> store, store::RouteStore& routes)
      : server_(std::move(server)), store_(std::move(store)), routes_(routes) {}

  [[nodiscard]] Result<std::vector<network::Change>> FirstSeen(const route::RouteInfo& info);
  [[nodiscard]] Result<void> FillReply(const exchange::NetworkRequest& request,
                                       std::int64_t since_unix_ms, std::int64_t now_unix_ms,
                                       exchange::NetworkReply& reply);

  AgentId server_;
  std::unique_ptr<store::HistoryStore> store_;
  store::RouteStore& routes_;
  std::int64_t began_unix_ms_ = 0;
};

}  // namespace trailcast::server
