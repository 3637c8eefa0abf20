#include "services/program/presence.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <utility>
#include <variant>

#include "services/base/text.h"
#include "services/exchange/bounds.h"
#include "services/exchange/publish.h"
#include "services/program/command_line.h"

namespace trailcast::program {
namespace {

exchange::AgentStatus Starting(exchange::AgentStatus status) {
  if (status.instance == 0) status.instance = MakeInstance();
  status.mode = exchange::AgentMode::kStarting;
  status.software = Version();
  return status;
}

// Room for a low battery in a status's line.
constexpr std::size_t kBatteryLineBytes = 32;

}  // namespace

Presence::Presence(exchange::RouteExchange& exchange, exchange::AgentStatus status,
                   std::chrono::milliseconds interval)
    : exchange_(exchange), status_(Starting(status)), claim_(status_), interval_(interval) {
  if (status.instance == 0) reach_.emplace(status_.agent, status_.role);
}

Result<void> Presence::Claim(const Handler& handle, const std::function<bool()>& stop) {
  Publish();
  const auto deadline = Clock::now() + NameClaim::kListening;
  while (Clock::now() < deadline && !stop()) {
    for (const exchange::Message& message : exchange_.Take(std::chrono::milliseconds(50))) {
      Handle(message);
      handle(message);
      if (auto seen = See(message); !seen) return seen;
    }
    Tick(Clock::now());
  }
  return {};
}

Result<void> Presence::See(const exchange::Message& message) const {
  if (const auto* status = std::get_if<exchange::AgentStatus>(&message)) return claim_.See(*status);
  const auto* fleet = std::get_if<exchange::Fleet>(&message);
  if (fleet == nullptr) return {};
  for (const exchange::ClaimedName& claimed : fleet->claimed) {
    if (auto seen = claim_.See(claimed); !seen) return seen;
  }
  return {};
}

void Presence::Handle(const exchange::Message& message) {
  servers_.Handle(message);
  ChooseServer();
  if (const auto* gone = std::get_if<exchange::AgentGone>(&message)) {
    Hear(*gone);
  } else if (const auto* status = std::get_if<exchange::AgentStatus>(&message)) {
    Hear(*status);
  } else if (const auto* fleet = std::get_if<exchange::Fleet>(&message)) {
    Hear(*fleet);
  }
  if (!reach_) return;
  reach_->Handle(message, Clock::now());
  // An answer that cannot be sent is asked for again.
  (void)exchange::PublishAll(exchange_, reach_->TakeOutgoing());
}

void Presence::Hear(const exchange::AgentGone& gone) {
  others_.erase(gone.agent);
  told_.erase(gone.agent);
  if (gone.agent == status_.agent && gone.instance == namesake_) namesake_ = 0;
}

void Presence::Hear(const exchange::AgentStatus& status) {
  if (others_.size() < kMostAgents) others_.insert(status.agent);
  AnswerClaim(status);
  const bool ended = status.mode == exchange::AgentMode::kStopped;
  if (status.agent == status_.agent && status.instance != status_.instance) {
    const bool claims = status.mode == exchange::AgentMode::kStarting;
    if (ended && status.instance == namesake_) namesake_ = 0;
    if (!ended && !claims) namesake_ = status.instance;
  }
}

// Keeps the present server as long as it is there.
void Presence::ChooseServer() {
  if (server_ && servers_.Contains(*server_)) return;
  server_.reset();
  if (!servers_.empty()) server_ = *servers_.Names().begin();
}

void Presence::Hear(const exchange::Fleet& fleet) {
  if (!told_.contains(fleet.server) && told_.size() >= exchange::ServersThere::kMost) return;
  Told& told = told_[fleet.server];
  told = {.agents = fleet.agents, .namesake = 0};
  for (const exchange::ClaimedName& claimed : fleet.claimed) {
    if (claimed.agent != status_.agent) continue;
    const bool own = claimed.claims == status_.instance;
    // The owner of the name answers.
    if (claimed.keeps == 0 && !own) Publish();
    if (claimed.keeps != 0) told.namesake = own ? claimed.keeps : claimed.claims;
  }
}

std::string Presence::NameTrouble() const {
  std::uint64_t other = namesake_;
  for (const auto& [server, told] : told_) other = std::max(other, told.namesake);
  if (other == 0) return "";
  return fmt::format(
      "another running process is called '{}', too (instance {:016x}): end one of them, or give it "
      "another --name",
      status_.agent.value(), other);
}

void Presence::TellNameTrouble() {
  std::string trouble = NameTrouble();
  if (trouble == name_trouble_) return;
  spdlog::warn("{}", trouble.empty() ? "no other process has this one's name any more" : trouble);
  name_trouble_ = std::move(trouble);
}

void Presence::AnswerClaim(const exchange::AgentStatus& status) {
  using exchange::AgentMode;
  const bool claims = status.agent == status_.agent && status.instance != status_.instance &&
                      status.mode == AgentMode::kStarting;
  if (claims && status_.mode != AgentMode::kStarting) Publish();
}

void Presence::Set(exchange::AgentStatus status) {
  status.agent = status_.agent;
  status.role = status_.role;
  status.instance = status_.instance;
  status.software = status_.software;
  // A low battery is mentioned after the text.
  status.detail = PlainText(status.detail, exchange::kMaxLineBytes - kBatteryLineBytes);
  status_ = std::move(status);
}

void Presence::Tick(Clock::time_point now) {
  TellNameTrouble();
  if (now >= next_ || published_ != std::pair(status_.mode, status_.hold)) Publish();
}

void Presence::Publish() {
  exchange::AgentStatus status = status_;
  const Vitals vitals = vitals_();
  status.battery_percent = vitals.battery_percent;
  status.link_percent = vitals.link_percent;
  if (vitals.battery_percent && *vitals.battery_percent < kBatteryLow_percent) {
    status.detail = fmt::format("{}{}battery low: {} %", status.detail,
                                status.detail.empty() ? "" : "; ", *vitals.battery_percent);
  }
  if (std::string trouble = NameTrouble(); !trouble.empty()) status.detail = std::move(trouble);
  // If a status cannot be sent, the next one follows.
  if (exchange_.Publish(status)) published_ = {status_.mode, status_.hold};
  std::size_t agents = others_.size();
  for (const auto& [server, told] : told_) agents = std::max<std::size_t>(agents, told.agents);
  next_ = Clock::now() + std::max(interval_, kForEachAgent * static_cast<int>(agents));
}

exchange::TopicUse WithAgents(exchange::TopicUse use) {
  constexpr exchange::Topic kAgents = exchange::Topic::kAgents;
  if (!use.Writes(kAgents)) use.write.push_back(kAgents);
  if (!use.Hears(kAgents)) use.overhear.push_back(kAgents);
  if (!use.Writes(exchange::Topic::kFleet)) use.read.push_back(exchange::Topic::kFleet);
  constexpr exchange::Topic kAsked = exchange::Topic::kReachRequests;
  constexpr exchange::Topic kAnswer = exchange::Topic::kReachReports;
  if (!use.Reads(kAsked)) use.read.push_back(kAsked);
  if (!use.Writes(kAnswer)) use.write_rarely.push_back(kAnswer);
  return use;
}

}  // namespace trailcast::program
