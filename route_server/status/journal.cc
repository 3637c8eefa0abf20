#include "route_server/status/journal.h"

#include "services/base/text.h"
#include "services/route/labels.h"

#include <fmt/format.h>

#include <utility>
#include <variant>

namespace trailcast::server {
namespace {

constexpr std::size_t kMostRoutes = 10'000;

const char* ToString(exchange::AgentRole role) {
  switch (role) {
    case exchange::AgentRole::kServer:
      return "server";
    case exchange::AgentRole::kScout:
      return "scout";
    case exchange::AgentRole::kFollower:
      return "follower";
    case exchange::AgentRole::kOperator:
      return "operator";
  }
  return "agent";
}

}  // namespace

Journal::Known& Journal::KnownOf(const route::RouteKey& key) {
  if (routes_.size() >= kMostRoutes && !routes_.contains(key)) routes_.clear();
  return routes_[key];
}

std::string Journal::NameOf(const route::RouteKey& key) const {
  const auto known = routes_.find(key);
  if (known == routes_.end() || known->second.name.empty()) return key.route.value();
  return fmt::format("'{}' revision {}", known->second.name, known->second.revision);
}

std::optional<std::string> Journal::Received(const exchange::Message& message) {
  if (const auto* announcement = std::get_if<exchange::RouteAnnouncement>(&message)) {
    return On(*announcement);
  }
  if (const auto* status = std::get_if<exchange::AgentStatus>(&message)) return On(*status);
  if (const auto* gone = std::get_if<exchange::AgentGone>(&message)) return On(*gone);
  if (const auto* command = std::get_if<exchange::NowCommand>(&message)) return On(*command);
  if (const auto* answer = std::get_if<exchange::NowAnswer>(&message)) return On(*answer);
  if (const auto* request = std::get_if<exchange::SegmentRequest>(&message)) {
    return fmt::format("'{}' asks for {} segments of {}, from {} on", request->requester.value(),
                       request->lacking.size(), NameOf(request->key),
                       request->lacking.empty() ? 0U : request->lacking.front().value());
  }
  return std::nullopt;
}

std::optional<std::string> Journal::Sent(const exchange::Message& message) {
  if (const auto* receipt = std::get_if<exchange::Receipt>(&message)) return On(*receipt);
  // The server's announcements from its own store tell the journal the names.
  if (const auto* announcement = std::get_if<exchange::RouteAnnouncement>(&message)) {
    Known& known = KnownOf(announcement->info.key);
    known.name = announcement->info.name;
    known.revision = route::RevisionText(announcement->info);
  }
  if (const auto* reply = std::get_if<exchange::CatalogReply>(&message)) {
    if (!reply->error.empty()) {
      return fmt::format("could not answer '{}': {}", reply->client.value(), reply->error);
    }
    // A client asks every second until its route is there, but once is enough in the log.
    if (reply->request != 1) return std::nullopt;
    return reply->page.routes.empty()
               ? fmt::format("'{}' asks for a route that is not here", reply->client.value())
               : fmt::format("'{}' asks the catalog: {} routes, the first '{}'",
                             reply->client.value(), reply->page.routes.size(),
                             reply->page.routes.front().name);
  }
  return std::nullopt;
}

std::optional<std::string> Journal::On(const exchange::NowCommand& command) {
  if (std::exchange(commands_.Touch({command.client, command.number}), true)) return std::nullopt;
  const std::string whom = command.whom == exchange::NowWhom::kAll ? "all robots"
                           : command.whom == exchange::NowWhom::kOnRoute
                               ? "the robots on route '" + command.name + "'"
                               : "'" + command.name + "'";
  return fmt::format("'{}' tells {} to {}{}", command.client.value(), whom,
                     exchange::ToString(command.order),
                     command.reason.empty() ? "" : ": " + PlainText(command.reason, 200));
}

std::optional<std::string> Journal::On(const exchange::NowAnswer& answer) {
  const NowKey command{answer.client, answer.number};
  if (std::exchange(answers_.Touch({answer.agent, command}), true)) return std::nullopt;
  return fmt::format("'{}' {} '{}': {}", answer.agent.value(),
                     answer.refused ? "does not obey" : "obeys", answer.client.value(),
                     PlainText(answer.detail, 200));
}

std::optional<std::string> Journal::On(const exchange::RouteAnnouncement& announcement) {
  const route::RouteInfo& info = announcement.info;
  const bool is_new = !routes_.contains(info.key);
  Known& known = KnownOf(info.key);
  known.name = info.name;
  known.revision = route::RevisionText(info);
  if (!is_new) return std::nullopt;
  const bool scouts = announcement.holder == info.scout;
  return fmt::format("{}'{}' {} route {} with camera {}: {} segments so far",
                     scouts ? "scout " : "", announcement.holder.value(),
                     info.state == route::RouteState::kComplete ? "offers" : "teaches",
                     NameOf(info.key), info.camera, info.segment_count);
}

std::optional<std::string> Journal::On(const exchange::AgentStatus& status) {
  const bool is_new = agents_.Find(status.agent) == nullptr;
  const std::uint64_t before = std::exchange(agents_.Touch(status.agent), status.instance);
  const bool again = !is_new && before != status.instance;
  if (!is_new && !again) return std::nullopt;
  return fmt::format("{} '{}' is there{}", ToString(status.role), status.agent.value(),
                     again ? " again" : "");
}

std::optional<std::string> Journal::On(const exchange::AgentGone& gone) {
  const std::uint64_t* instance = agents_.Find(gone.agent);
  if (instance == nullptr || *instance != gone.instance) return std::nullopt;
  agents_.Erase(gone.agent);
  return fmt::format("'{}' is gone", gone.agent.value());
}

std::optional<std::string> Journal::On(const exchange::Receipt& receipt) {
  Known& known = KnownOf(receipt.key);
  const auto durable =
      receipt.durable_prefix + static_cast<std::uint32_t>(receipt.durable_beyond.size());
  // Two hundred scouts have a segment acknowledged each second, so a growing route gets a line each
  // time that it has doubled.
  const bool complete = receipt.durable_state == route::RouteState::kComplete;
  const std::uint32_t worth_telling = complete ? known.told_durable + 1 : 2 * known.told_durable;
  if (durable == 0 || durable < worth_telling) return std::nullopt;
  known.told_durable = durable;
  return fmt::format("route {}: {} segments stored and acknowledged{}", NameOf(receipt.key),
                     durable, complete ? ", complete" : "");
}

}  // namespace trailcast::server
