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

// What has changed of routes and of how they are joined, and who did it. Of a revision it tells
// what is other than when it was noted last, so that the same news again is none. No clock of its
// own, and no robot's.
class History {
 public:
  // `routes` outlives it. Of what was there before a new file was made nothing is told.
  [[nodiscard]] static Result<std::unique_ptr<History>> Open(
      AgentId server, std::unique_ptr<store::HistoryStore> store, store::RouteStore& routes,
      std::int64_t now_unix_ms);

  // Revisions as they are. `by`: who made them so; empty: not known.
  [[nodiscard]] Result<void> Note(std::span<const route::RouteInfo> infos, const std::string& by,
                                  std::int64_t now_unix_ms);
  // The same of these as they are stored.
  [[nodiscard]] Result<void> NoteStored(std::span<const route::RouteKey> keys,
                                        const std::string& by, std::int64_t now_unix_ms);
  // Of how routes are joined.
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
