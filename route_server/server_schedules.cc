// This part of the server sends missions at times.
#include <spdlog/spdlog.h>

#include "route_server/server.h"
#include "services/base/unix_time.h"
#include "services/mission/orders.h"
#include "services/schedule/listed.h"

namespace trailcast::server {

using std::chrono::steady_clock;

Result<void> Server::OpenSchedules() {
  ScheduleRegistry::Site site;
  site.take = [this](std::span<const mission::Mission> missions, steady_clock::time_point now,
                     std::int64_t now_unix_ms) { missions_->Take(missions, now, now_unix_ms); };
  site.closed = [this](const std::string& orders) { return ClosedIn(orders); };
  auto registry =
      ScheduleRegistry::Open(presence_.status().agent, missions_->store(), std::move(site));
  if (!registry) return tl::unexpected(registry.error());
  schedules_ = std::move(*registry);
  return {};
}

void Server::TellSchedules() {
  schedules_->Tick(steady_clock::now(), NowUnixMs());
  for (const std::string& note : schedules_->TakeNotes()) spdlog::info("{}", note);
}

// Each server keeps its own schedules, so a change that names another one is left to that.
bool Server::ServeSchedules(const exchange::Message& request) {
  const AgentId& self = presence_.status().agent;
  const auto* question = std::get_if<exchange::NetworkRequest>(&request);
  const auto* edit = std::get_if<exchange::NetworkEdit>(&request);
  const bool asks = question != nullptr && question->words == schedule::kQuestion;
  const bool changes = edit != nullptr && schedule::IsEdit(edit->words);
  if (!asks && !changes) return false;
  if (changes && schedule::ServerOf(edit->words) != self.value()) return true;
  if (!schedules_) {
    exchange::NetworkReply reply{.server = self,
                                 .client = asks ? question->client : edit->client,
                                 .request = asks ? question->request : edit->request};
    reply.error =
        "keeps no schedules, because it keeps no missions: its log says why, or it was given no "
        "--missions";
    replies_.emplace_back(std::move(reply));
  } else if (asks) {
    replies_.emplace_back(schedules_->Answer(*question));
  } else {
    replies_.emplace_back(schedules_->Change(*edit, NowUnixMs()));
  }
  return true;
}

std::string Server::ClosedIn(const std::string& orders) {
  const auto tasks = mission::ParseOrders(orders);
  if (!network_ || !tasks) return "";
  for (std::size_t i = 0; i < tasks->size(); ++i) {
    if ((*tasks)[i].kind != mission::Task::Kind::kFollow) continue;
    // A robot refuses a route that there is not, and says so.
    const auto section = network_->SectionOf(*tasks, i);
    if (!section) continue;
    const auto closed = network_->FirstClosed(*section);
    if (!closed) return "whether it is closed is not known: " + closed.error().message;
    if (*closed) return network_->Called(**closed) + " is closed";
  }
  return "";
}

}  // namespace trailcast::server
