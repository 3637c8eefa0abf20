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

// This says which revision of a route is meant: the one of a number, or else the newest complete
// one, to be held in advance even while another is active, or else the one to follow.
struct RevisionChoice {
  std::uint32_t number = 0;  // 0 for none in particular
  bool newest = false;
  std::string scout{};  // its scout; empty for any
};

// Returns the one that is meant of several routes (or revisions) with one name. The one to follow
// is the active one. If no operator and no server has said anything of a route, it is the newest
// complete one, otherwise the newest, but never one that is held back. Returns nothing if there is
// none.
[[nodiscard]] std::optional<route::RouteInfo> ChooseRoute(
    const std::vector<route::RouteInfo>& routes, const RevisionChoice& which = {});

// Returns the revision that is meant of each route that a name, or the beginning of an id, may
// mean, if there is more than one route: two scouts may have given the name.
[[nodiscard]] std::vector<route::RouteInfo> FindRivals(const std::vector<route::RouteInfo>& routes,
                                                       const RevisionChoice& which = {});
// Returns kConflict, with the candidates and how to say which is meant.
[[nodiscard]] tl::unexpected<Error> Ambiguous(const std::string& name_or_id,
                                              const std::vector<route::RouteInfo>& rivals);

// Says that `holder` has revisions of a route, at least one, and that none of them is meant:
// "server 'barn' has no active revision of route 'hall'; it has a3f9c21@1 (cut off)".
[[nodiscard]] std::string NotMeantText(const std::string& holder, const std::string& name_or_id,
                                       const std::vector<route::RouteInfo>& others,
                                       const RevisionChoice& which = {});
// Returns kNotFound with the same, why robots follow none of them, and what to do.
[[nodiscard]] Error NotMeant(const std::string& holder, const std::string& name_or_id,
                             const std::vector<route::RouteInfo>& others,
                             const RevisionChoice& which = {});

// Returns the one that a name, or the beginning of an id, means, as ChooseRoute does, or Ambiguous
// if it may be any of several.
[[nodiscard]] Result<std::optional<route::RouteInfo>> ChooseMeant(
    const std::string& name_or_id, const std::vector<route::RouteInfo>& routes,
    const RevisionChoice& which = {});

// This asks the catalog which route has a name, or an id that begins so, again and again until one
// has. No clock, no I/O.
class RouteFinder {
 public:
  using Time = std::chrono::steady_clock::time_point;
  static constexpr std::chrono::milliseconds kAskEvery{1000};
  static constexpr std::size_t kMaxAnnounced = 64;

  RouteFinder(AgentId self, std::string name_or_id, RevisionChoice which = {})
      : self_(std::move(self)), name_or_id_(std::move(name_or_id)), which_(std::move(which)) {}

  void Handle(const exchange::Message& message);
  [[nodiscard]] std::vector<exchange::Message> Tick(Time now);

  // Returns the route from a catalog's reply.
  [[nodiscard]] const std::optional<route::RouteInfo>& found() const { return found_; }
  // Returns the route as a holder or the scout announced it. A catalog's reply counts more, since a
  // catalog knows all routes.
  [[nodiscard]] std::optional<route::RouteInfo> announced() const {
    return ChooseRoute(route::OnlyMeant(announced_, name_or_id_), which_);
  }
  [[nodiscard]] std::vector<route::RouteInfo> announced_rivals() const {
    return FindRivals(route::OnlyMeant(announced_, name_or_id_), which_);
  }

  // Returns the candidates of a catalog's reply if more than one could be meant. Nothing is found
  // then.
  [[nodiscard]] const std::vector<route::RouteInfo>& rivals() const { return rivals_; }
  // A server has said that it has no route of this name, or none that may be followed.
  struct Unknown {
    AgentId server;
    std::vector<std::string> similar_names;
    std::vector<route::RouteInfo> others{};  // of this name, but none of them is meant
  };
  // An answer with revisions of the route counts more than one without, of several servers.
  [[nodiscard]] const std::optional<Unknown>& unknown() const { return unknown_; }
  // Tells that all of `servers` have said so.
  [[nodiscard]] bool IsUnknownTo(const std::set<AgentId>& servers) const;
  // Returns why a server could not answer.
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
  std::optional<Unknown> unknown_;
  std::set<AgentId> unknown_to_;  // servers that said so, at most kMaxAnnounced
  std::string error_;
};

}  // namespace trailcast::exchange
