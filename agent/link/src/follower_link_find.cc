// This part of FollowerLink decides which route is followed: the own store's, or as the network
// knows it.
#include <spdlog/spdlog.h>

#include <utility>
#include <vector>

#include "agent/link/follower_link.h"
#include "services/base/time.h"
#include "services/route/no_route.h"

namespace trailcast::agent {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

// A robot that has the route waits no longer than this for a server's opinion.
constexpr milliseconds kServerPatience{3000};

// Says that `holder`, "server 'barn'" or "robot.db", has no such route, or `others` of which none
// is meant.
Error NotThere(const std::string& holder, const std::vector<route::RouteInfo>& others,
               const std::vector<std::string>& names, const FollowerLinkOptions& options) {
  if (others.empty()) {
    return {ErrorCode::kNotFound, route::NoRouteText(holder, options.route, names)};
  }
  return exchange::NotMeant(holder, options.route, others, options.revision);
}

Error NotThere(const exchange::RouteFinder::Unknown& unknown, const FollowerLinkOptions& options) {
  return NotThere(fmt::format("server '{}'", unknown.server.value()), unknown.others,
                  unknown.similar_names, options);
}

}  // namespace

Result<std::optional<route::RouteInfo>> FollowerLink::FindOwn() {
  const auto meant = store_->FindMeant(options_.route);
  if (!meant) return tl::unexpected(meant.error());
  return exchange::ChooseMeant(options_.route, *meant, options_.revision);
}

Result<void> FollowerLink::Find() {
  auto own = FindOwn();
  const bool rivals_here = !own && own.error().code == ErrorCode::kConflict;
  if (!own && !(rivals_here && exchange_)) return tl::unexpected(own.error());
  if (rivals_here) {
    spdlog::warn("{}: a server may know which", own.error().message);
    own = std::nullopt;
  }
  if (!exchange_) {
    route_ = *own;
    if (route_) return {};
    std::vector<std::string> names;
    if (auto routes = store_->ListRoutes()) {
      for (const route::RouteInfo& info : *routes) names.push_back(info.name);
    }
    const auto others = store_->FindMeant(options_.route);
    return tl::unexpected(NotThere(
        options_.store_file, others.value_or(std::vector<route::RouteInfo>()), names, options_));
  }
  waiting_for_ = fmt::format("waiting for a server that knows route '{}'", options_.route);
  spdlog::info("asking for route '{}'", options_.route);
  const auto began = steady_clock::now();
  while (!over() && !route_) {
    Trade();
    if (auto asked = Asked(began, *own); !asked) return tl::unexpected(asked.error());
  }
  return {};
}

// Sets route_ once it is clear which one is meant. An error means that none will be.
Result<bool> FollowerLink::Asked(Time began, const std::optional<route::RouteInfo>& own) {
  const auto waited = steady_clock::now() - began;
  // There may be several servers, each with routes of its own.
  const bool all_answered = finder_.IsUnknownTo(presence_->servers()) || waited > kServerPatience;
  const bool unknown = finder_.unknown() && all_answered;
  const bool settled = unknown || waited > kServerPatience;
  if (!finder_.rivals().empty()) return exchange::Ambiguous(options_.route, finder_.rivals());
  if (finder_.found()) {
    route_ = finder_.found();
  } else if (const auto rivals = finder_.announced_rivals(); settled && !rivals.empty()) {
    return exchange::Ambiguous(options_.route, rivals);
  } else if (settled && finder_.announced()) {
    route_ = finder_.announced();
  } else if (settled && own) {
    spdlog::warn("{}: following '{}' from {}",
                 unknown ? NotThere(*finder_.unknown(), options_).message : "no server answers",
                 options_.route, options_.store_file);
    route_ = own;
  } else if (unknown && !options_.wait_for_route) {
    return tl::unexpected(NotThere(*finder_.unknown(), options_));
  } else if (waited > options_.wait) {
    return tl::unexpected(WaitedInVain());
  } else if (finder_.unknown() && finder_.unknown()->others.empty()) {
    waiting_for_ = fmt::format("waiting for a scout to teach route '{}'", options_.route);
  } else if (finder_.unknown()) {
    waiting_for_ =
        "waiting for another revision: " + NotThere(*finder_.unknown(), options_).message;
  }
  return route_.has_value();
}

Error FollowerLink::WaitedInVain() const {
  const auto& unknown = finder_.unknown();
  const double waited_s = Seconds(options_.wait);
  if (unknown && !unknown->others.empty()) {
    return {ErrorCode::kNotFound, fmt::format("waited {:.0f} s in vain: {}", waited_s,
                                              NotThere(*unknown, options_).message)};
  }
  if (unknown) {
    return {ErrorCode::kNotFound,
            fmt::format("nobody taught route '{}' within {:.0f} s: server '{}' {}", options_.route,
                        waited_s, unknown->server.value(),
                        finder_.error().empty() ? "does not know it" : finder_.error())};
  }
  if (!finder_.error().empty()) {
    return {ErrorCode::kUnavailable,
            fmt::format("no server could say within {:.0f} s which revision of route '{}' is "
                        "meant: {}",
                        waited_s, options_.route, finder_.error())};
  }
  return {ErrorCode::kUnavailable,
          fmt::format("no server answered within {:.0f} s, and {} has no route '{}': is "
                      "trailcast-server running with the same --domain and --dds-tag? With "
                      "--security: are this robot's keys valid, and not revoked?",
                      waited_s, options_.store_file, options_.route)};
}

}  // namespace trailcast::agent
