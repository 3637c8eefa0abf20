#pragma once

#include <chrono>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "services/exchange/reach_desk.h"
#include "services/exchange/route_exchange.h"
#include "services/exchange/servers_there.h"
#include "services/program/name_claim.h"

namespace trailcast::program {

// What is known of a robot itself: 0 to 100.
struct Vitals {
  std::optional<std::uint8_t> battery_percent{};
  std::optional<std::uint8_t> link_percent{};
};

// An agent as its peers see it: claims its name, publishes its status, notes whether a server is
// heard, and answers who asks whom it hears. Owned by the thread that owns the exchange.
class Presence {
 public:
  using Clock = std::chrono::steady_clock;
  using Handler = std::function<void(const exchange::Message&)>;
  // What all agents together may say: every one of them hears every status.
  static constexpr std::chrono::milliseconds kForEachAgent{10};
  // Strangers can make up names: more are not kept.
  static constexpr std::size_t kMostAgents = 4096;
  // A battery below this is told in words, too.
  static constexpr std::uint8_t kBatteryLow_percent = 20;

  // `exchange` outlives this. `status` names agent and role, and the instance of a
  // process that has one already; its mode is set here. The
  // status is published every `interval` (less often in a swarm, so that each of its agents has
  // kForEachAgent), and when the mode changes or how operators hold it.
  Presence(exchange::RouteExchange& exchange, exchange::AgentStatus status,
           std::chrono::milliseconds interval = std::chrono::milliseconds(200));

  // Publishes kStarting and listens; everything heard goes to `handle` too. kConflict when another
  // running process has the name. Ends early, without error, when `stop` says so.
  [[nodiscard]] Result<void> Claim(const Handler& handle, const std::function<bool()>& stop);

  // Notes whether a server speaks, how many agents there are and who else has the name; answers who
  // claims it. What servers tell of others counts as if it was heard.
  void Handle(const exchange::Message& message);

  // Asked of the robot whenever its status is published, from the thread that does so.
  void FeelBy(std::function<Vitals()> vitals) { vitals_ = std::move(vitals); }
  // The status to be published from now on; agent, role, instance and version stay.
  void Set(exchange::AgentStatus status);
  [[nodiscard]] const exchange::AgentStatus& status() const { return status_; }
  // Publishes when the interval has passed, or the mode or the hold has changed.
  void Tick(Clock::time_point now);
  // Publishes now.
  void Publish();

  // A server that was heard and has not gone since; of several the same one as long as it is there.
  [[nodiscard]] const std::optional<AgentId>& server() const { return server_; }
  // All of these.
  [[nodiscard]] std::set<AgentId> servers() const { return servers_.Names(); }
  // That another running process has the name, which was not found out when it started; empty: none
  // has. Published with the status, and told in the log.
  [[nodiscard]] std::string NameTrouble() const;

 private:
  // kConflict when somebody else keeps the name.
  [[nodiscard]] Result<void> See(const exchange::Message& message) const;
  // Who claims this one's name did not hear what it said before: tells whose the name is.
  void AnswerClaim(const exchange::AgentStatus& status);
  void Hear(const exchange::AgentStatus& status);
  void Hear(const exchange::AgentGone& gone);
  void Hear(const exchange::Fleet& fleet);
  void ChooseServer();
  void TellNameTrouble();

  exchange::RouteExchange& exchange_;
  exchange::AgentStatus status_;
  NameClaim claim_;
  std::chrono::milliseconds interval_;
  std::function<Vitals()> vitals_ = [] { return Vitals{}; };
  std::optional<std::pair<exchange::AgentMode, exchange::AgentHold>> published_;
  Clock::time_point next_{};
  exchange::ServersThere servers_;
  std::optional<AgentId> server_;  // one of those
  std::set<AgentId> others_;       // heard, and not gone since
  // What each server tells of those who are not heard.
  struct Told {
    std::uint32_t agents = 0;
    std::uint64_t namesake = 0;  // the instance of another process of this name; 0: none
  };
  std::map<AgentId, Told> told_;
  std::optional<exchange::ReachDesk> reach_;  // unless the process has one that answers already
  std::uint64_t namesake_ = 0;                // heard
  std::string name_trouble_;                  // as it was told in the log last
};

// Topics of a role, and the statuses of all agents, overheard where the role does not read them,
// and what servers tell of those who are not heard: a process must see whether its name is taken.
// And those by which it is asked whom it hears.
[[nodiscard]] exchange::TopicUse WithAgents(exchange::TopicUse use);

}  // namespace trailcast::program
