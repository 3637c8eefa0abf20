#pragma once

#include <chrono>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "services/base/result.h"
#include "services/exchange/messages.h"
#include "services/route/route_ref.h"

namespace trailcast::exchange {

// Which revision of a route is meant: that of a number; or else the newest that is complete, though
// another be active, to be held in advance; or else the one to follow.
struct RevisionChoice {
  std::uint32_t number = 0;  // 0: none in particular
  bool newest = false;
  std::string scout{};  // who taught it; empty: anybody
};

// Of several routes (or revisions) with one name, the one that is meant. To follow it is the active
// one; where no operator, and no server, has said anything of a route, the newest that is complete,
// otherwise the newest, but none that is held back. Nothing if there is none.
[[nodiscard]] std::optional<route::RouteInfo> ChooseRoute(
    const std::vector<route::RouteInfo>& routes, const RevisionChoice& which = {});

// Of several routes that a name, or the beginning of an id, may mean the revision that is meant of
// each, if there is more than one: two scouts may have given the name.
[[nodiscard]] std::vector<route::RouteInfo> FindRivals(const std::vector<route::RouteInfo>& routes,
                                                       const RevisionChoice& which = {});
// kConflict: which there are, and how to say which is meant.
[[nodiscard]] tl::unexpected<Error> Ambiguous(const std::string& name_or_id,
                                              const std::vector<route::RouteInfo>& rivals);

// Of what a name, or the beginning of an id, may mean the one that is meant, as ChooseRoute; or
// else that it may be any of several.
[[nodiscard]] Result<std::optional<route::RouteInfo>> ChooseMeant(
    const std::string& name_or_id, const std::vector<route::RouteInfo>& routes,
    const RevisionChoice& which = {});

// Asks the catalog which route has a name, or an id that begins so, again and again until one has.
// No clock, no I/O.
class RouteFinder {
 public:
  using Time = std::chrono::steady_clock::time_point;
  static constexpr std::chrono::milliseconds kAskEvery{1000};
  static constexpr std::size_t kMaxAnnounced = 64;

  RouteFinder(AgentId self, std::string name_or_id, RevisionChoice which = {})
      : self_(std::move(self)), name_or_id_(std::move(name_or_id)), which_(std::move(which)) {}

  void Handle(const exchange::Message& message);
  [[nodiscard]] std::vector<exchange::Message> Tick(Time now);

  // From a catalog's reply.
  [[nodiscard]] const std::optional<route::RouteInfo>& found() const { return found_; }
  // Announced by whoever holds or teaches it: second to what a catalog says, which knows them all.
  [[nodiscard]] std::optional<route::RouteInfo> announced() const {
    return ChooseRoute(route::OnlyMeant(announced_, name_or_id_), which_);
  }
  [[nodiscard]] std::vector<route::RouteInfo> announced_rivals() const {
    return FindRivals(route::OnlyMeant(announced_, name_or_id_), which_);
  }

  // From a catalog's reply: more than one that could be meant; nothing is found then.
  [[nodiscard]] const std::vector<route::RouteInfo>& rivals() const { return rivals_; }
  // A server's word that it has no route of this name, or none that may be followed.
  struct Unknown {
    AgentId server;
    std::vector<std::string> similar_names;
    std::vector<route::RouteInfo> others{};  // of this name, and none of them is meant
  };
  [[nodiscard]] const std::optional<Unknown>& unknown() const { return unknown_; }
  // All of `servers` have said so.
  [[nodiscard]] bool IsUnknownTo(const std::set<AgentId>& servers) const;
  // A server's trouble in answering.
  [[nodiscard]] const std::string& error() const { return error_; }

 private:
  void Learn(const exchange::CatalogReply& reply);
  void Learn(const exchange::RouteAnnouncement& announcement);

  AgentId self_;
  std::string name_or_id_;
  RevisionChoice which_;
  std::uint64_t asked_ = 0;
  std::optional<Time> asked_at_;
  std::optional<route::RouteInfo> found_;
  std::vector<route::RouteInfo> announced_;  // the latest of each key, at most kMaxAnnounced
  std::vector<route::RouteInfo> rivals_;
  std::optional<Unknown> unknown_;  // the last such word
  std::set<AgentId> unknown_to_;    // who said so, at most kMaxAnnounced
  std::string error_;
};

}  // namespace trailcast::exchange
