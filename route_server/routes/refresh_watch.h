#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "services/store/route_store.h"

namespace trailcast::server {

// Checks, segment by segment, that revisions with which robots refresh the followed one without
// review are what they claim to be, and so may replace it. It works in small parts.
class RefreshWatch {
 public:
  explicit RefreshWatch(store::RouteStore& store) : store_(store) {}  // `store` must outlive it

  // Notes that the knowledge of a revision has changed.
  void Note(const route::RouteInfo& info);
  // Notes, at the start, the revisions that came before the server was stopped and refresh what is
  // followed now. Errors are the store's.
  [[nodiscard]] Result<void> NoteStored();
  // Compares a segment. Returns false if there is nothing to do. An error is the store's; the
  // compared revision stays as it is.
  [[nodiscard]] Result<bool> Step();

  struct Judged {
    route::RouteInfo info;
    std::string why_not;  // one line for people; empty if robots may follow it
  };
  // Returns those since the last call.
  [[nodiscard]] std::vector<Judged> TakeJudged() { return std::exchange(judged_, {}); }

 private:
  static constexpr std::size_t kMostWaiting = 1000;

  struct Comparison {
    route::RouteInfo refreshed;
    route::RouteInfo followed;
    std::uint32_t next = 0;
  };
  [[nodiscard]] Result<std::optional<route::RouteInfo>> FollowedOf(
      const route::RouteKey& key) const;
  [[nodiscard]] Result<void> Begin(route::RouteInfo refreshed);
  [[nodiscard]] Result<bool> TryStep();
  void Judge(route::RouteInfo info, std::string why_not);

  store::RouteStore& store_;
  std::deque<route::RouteInfo> waiting_;
  std::optional<Comparison> comparison_;
  std::vector<Judged> judged_;
};

}  // namespace trailcast::server
