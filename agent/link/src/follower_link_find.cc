// Which route it is that shall be followed: from the own store, or as the network knows it.
#include <spdlog/spdlog.h>

#include <vector>

#include "agent/link/follower_link.h"
#include "services/base/time.h"

namespace trailcast::agent {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

// Who has the route already does not wait longer than this for a server's word on it.
constexpr milliseconds kServerPatience{3000};

std::string NamesText(const std::vector<std::string>& names) {
  return names.empty() ? "it has none" : fmt::format("it has: {}", fmt::join(names, ", "));
}

// There are revisions, but not the one that is meant.
Error NotOffered(const AgentId& server, const FollowerLinkOptions& options) {
  const std::string what =
      options.revision.number != 0
          ? fmt::format("revision {} of route '{}': 'trailcast routes --name {}' lists what it has",
                        options.revision.number, options.route, options.route)
          : fmt::format(
                "active revision of route '{}': 'trailcast routes activate {}' activates "
                "the newest",
                options.route, options.route);
  return {ErrorCode::kNotFound, fmt::format("server '{}' has no {}", server.value(), what)};
}

}  // namespace

Result<std::optional<route::RouteInfo>> FollowerLink::FindOwn() {
  const auto meant = store_->FindMeant(options_.route);
  if (!meant) return tl::unexpected(meant.error());
  const auto rivals = exchange::FindRivals(*meant, options_.revision);
  if (!rivals.empty()) return exchange::Ambiguous(options_.route, rivals);
  return exchange::ChooseRoute(*meant, options_.revision);
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
    return Fail(ErrorCode::kNotFound, "there is no route '{}' in {}: {}", options_.route,
                options_.store_file, NamesText(names));
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

// Sets route_ when it is clear which one it is; an error when none will be.
Result<bool> FollowerLink::Asked(Time began, const std::optional<route::RouteInfo>& own) {
  const auto waited = steady_clock::now() - began;
  // Of several servers each may have routes of its own.
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
                 unknown ? "the server does not know the route" : "no server answers",
                 options_.route, options_.store_file);
    route_ = own;
  } else if (unknown && finder_.unknown()->others && !options_.wait_for_route) {
    return tl::unexpected(NotOffered(finder_.unknown()->server, options_));
  } else if (unknown && !options_.wait_for_route) {
    return Fail(ErrorCode::kNotFound, "server '{}' has no route '{}': {}",
                finder_.unknown()->server.value(), options_.route,
                NamesText(finder_.unknown()->similar_names));
  } else if (waited > options_.wait) {
    if (finder_.unknown()) {
      return Fail(ErrorCode::kNotFound, "nobody taught route '{}' within {:.0f} s: server '{}' {}",
                  options_.route, Seconds(options_.wait), finder_.unknown()->server.value(),
                  finder_.error().empty() ? "does not know it" : finder_.error());
    }
    return Fail(
        ErrorCode::kUnavailable,
        "no server answered within {:.0f} s, and {} has no route '{}': is trailcast-server "
        "running with the same --domain and --dds-tag? With --security: are this robot's keys "
        "valid, and not revoked?",
        Seconds(options_.wait), options_.store_file, options_.route);
  } else if (finder_.unknown()) {
    waiting_for_ = fmt::format("waiting for a scout to teach route '{}'", options_.route);
  }
  return route_.has_value();
}

}  // namespace trailcast::agent
