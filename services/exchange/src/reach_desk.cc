#include "services/exchange/reach_desk.h"

#include <algorithm>

#include "services/exchange/bounds.h"

namespace trailcast::exchange {
namespace {

std::chrono::milliseconds Since(ReachDesk::Time then, ReachDesk::Time now) {
  return std::chrono::duration_cast<std::chrono::milliseconds>(now - then);
}

}  // namespace

void ReachDesk::Handle(const Message& message, Time now) {
  if (const auto* status = std::get_if<AgentStatus>(&message)) {
    Hear(*status, now);
  } else if (const auto* gone = std::get_if<AgentGone>(&message)) {
    const auto known = heard_.find(gone->agent);
    if (known != heard_.end() && known->second.instance == gone->instance) heard_.erase(known);
  } else if (const auto* request = std::get_if<ReachRequest>(&message)) {
    Answer(*request, now);
  } else if (const auto* report = std::get_if<ReachReport>(&message)) {
    Measure(*report, now);
  }
}

void ReachDesk::Hear(const AgentStatus& status, Time now) {
  if (status.agent == self_) return;
  if (!heard_.contains(status.agent) && heard_.size() >= kMostAgents) return;
  Known& known = heard_[status.agent];
  if (known.instance != status.instance) known = {.instance = status.instance, .since = now};
  known.role = status.role;
  known.last = now;
  known.arrival = status.arrival;
}

void ReachDesk::Answer(const ReachRequest& request, Time now) {
  if (request.server == self_ || role_ == AgentRole::kOperator) return;
  const std::vector<HeardAgent> heard = Heard(now);
  std::size_t before = 0;
  do {
    const std::size_t part = std::min(kMaxHeardAgents, heard.size() - before);
    const auto from = heard.begin() + static_cast<std::ptrdiff_t>(before);
    outgoing_.emplace_back(ReachReport{.agent = self_,
                                       .client = request.client,
                                       .request = request.request,
                                       .server = request.server,
                                       .role = role_,
                                       .heard = {from, from + static_cast<std::ptrdiff_t>(part)},
                                       .before = static_cast<std::uint32_t>(before)});
    before += part;
  } while (before < heard.size());
  if (role_ == AgentRole::kServer && !request.relayed) PassOn(request, now);
}

void ReachDesk::PassOn(const ReachRequest& request, Time now) {
  if (passed_on_at_ && now < *passed_on_at_ + kPassesOnEvery) return;
  passed_on_at_ = now;
  const ReachRequest passed_on{
      .client = request.client, .request = request.request, .relayed = true, .server = self_};
  outgoing_.emplace_back(passed_on);
  NoteAsked(passed_on, now);
}

void ReachDesk::NoteAsked(const ReachRequest& request, Time now) {
  constexpr std::size_t kMostAsked = 16;
  asked_.emplace_back(request, now);
  if (asked_.size() > kMostAsked) asked_.pop_front();
}

void ReachDesk::Measure(const ReachReport& report, Time now) {
  if (report.relayed) return;
  const auto asked = std::find_if(asked_.begin(), asked_.end(), [&](const auto& each) {
    return each.first.client == report.client && each.first.request == report.request &&
           each.first.server == report.server;
  });
  if (asked == asked_.end()) return;
  if (const auto known = heard_.find(report.agent); known != heard_.end()) {
    const double took_ms = std::chrono::duration<double, std::milli>(now - asked->second).count();
    Known& of = known->second;
    if (std::exchange(of.measured_for, report.client) != report.client) of.round_trip_ms.reset();
    of.round_trip_ms = std::min(of.round_trip_ms.value_or(took_ms), took_ms);
  }
  if (report.server != self_) return;
  ReachReport passed_on = report;
  passed_on.relayed = true;
  outgoing_.emplace_back(std::move(passed_on));
}

std::vector<HeardAgent> ReachDesk::Heard(Time now) const {
  std::vector<HeardAgent> heard;
  heard.reserve(heard_.size());
  for (const auto& [agent, known] : heard_) {
    heard.push_back({.agent = agent,
                     .role = known.role,
                     .heard_for = Since(known.since, now),
                     .age = Since(known.last, now),
                     .late_ms = known.arrival.late.count(),
                     .round_trip_ms = known.round_trip_ms,
                     .address = known.arrival.address,
                     .network = known.arrival.network});
  }
  return heard;
}

}  // namespace trailcast::exchange
