// This part of FollowerLink decides which route is followed: the own store's, or as the network
// knows it.
#include <spdlog/spdlog.h>

#include <algorithm>
#include <span>
#include <vector>

#include "agent/link/follower_link.h"
#include "services/base/time.h"
#include "services/route/labels.h"
#include "services/route/no_route.h"
#include "services/route/route_ref.h"

namespace trailcast::agent {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

// A robot that has the route waits no longer than this for a server's opinion.
constexpr milliseconds kServerPatience{3000};

// Says that there are revisions, but not the wanted one. `holder` is "server 'server'" or
// "robot.db".
Error NotOffered(const std::string& holder, std::vector<route::RouteInfo> others,
                 const FollowerLinkOptions& options) {
  constexpr std::size_t kShown = 4;
  std::sort(others.begin(), others.end(),
            [](const auto& a, const auto& b) { return a.revision > b.revision; });
  const route::ShortIds ids(others);
  std::vector<std::string> shown;
  for (const route::RouteInfo& info : std::span(others).first(std::min(kShown, others.size()))) {
    shown.push_back(fmt::format("{} ({})", ids.Of(info), route::StateText(info)));
  }
  if (others.size() > kShown) shown.emplace_back("..");
  const std::uint32_t number = options.revision.number;
  const std::string& scout = options.revision.scout;
  std::string message = fmt::format(
      "{} has no {} of route '{}'{}; it has {}", holder,
      number != 0 ? fmt::format("revision {}", number) : "active revision", options.route,
      scout.empty() ? "" : fmt::format(" of scout '{}'", scout), fmt::join(shown, ", "));
  if (number == 0) {
    const std::string id = ids.Of(others.front());
    message += fmt::format(
        ": 'trailcast routes activate {}' has robots follow that, '--route {}' this one alone", id,
        id);
  }
  return {ErrorCode::kNotFound, message};
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
    if (auto others = store_->FindMeant(options_.route); others && !others->empty()) {
      return tl::unexpected(NotOffered(options_.store_file, std::move(*others), options_));
    }
    std::vector<std::string> names;
    if (auto routes = store_->ListRoutes()) {
      for (const route::RouteInfo& info : *routes) names.push_back(info.name);
    }
    return Fail(ErrorCode::kNotFound, "{}",
                route::NoRouteText(options_.store_file, options_.route, names));
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
                 unknown ? "the server does not know the route" : "no server answers",
                 options_.route, options_.store_file);
    route_ = own;
  } else if (unknown && !finder_.unknown()->others.empty() && !options_.wait_for_route) {
    return tl::unexpected(NotOffered(fmt::format("server '{}'", finder_.unknown()->server.value()),
                                     finder_.unknown()->others, options_));
  } else if (unknown && !options_.wait_for_route) {
    return Fail(ErrorCode::kNotFound, "{}",
                route::NoRouteText(fmt::format("server '{}'", finder_.unknown()->server.value()),
                                   options_.route, finder_.unknown()->similar_names));
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
