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

// A robot's own values: 0 to 100.
struct Vitals {
  std::optional<std::uint8_t> battery_percent{};
  std::optional<std::uint8_t> link_percent{};
};

// An agent as its peers see it: it claims its name, publishes its status, notes whether a server is
// heard, and answers questions whom it hears. The thread that owns the exchange owns it.
class Presence {
 public:
  using Clock = std::chrono::steady_clock;
  using Handler = std::function<void(const exchange::Message&)>;
  // The share of each agent in the statuses of all, because every agent hears every status.
  static constexpr std::chrono::milliseconds kForEachAgent{10};
  // Strangers can make up names, so no more are kept.
  static constexpr std::size_t kMostAgents = 4096;
  // A battery below this is mentioned in words, too.
  static constexpr std::uint8_t kBatteryLow_percent = 20;

  // `exchange` must outlive this. `status` names agent and role, and the instance of a process that
  // has one already; its mode is set here. The status is published every `interval` (less often in
  // a swarm, so that each of its agents has kForEachAgent), and when its mode or the operators'
  // hold changes.
  Presence(exchange::RouteExchange& exchange, exchange::AgentStatus status,
           std::chrono::milliseconds interval = std::chrono::milliseconds(200));

  // Publishes kStarting and listens; `handle` gets everything heard as well. kConflict means that
  // another running process has the name. It ends early, without an error, if `stop` returns true.
  [[nodiscard]] Result<void> Claim(const Handler& handle, const std::function<bool()>& stop);

  // Notes whether a server is heard, how many agents there are and who else has the name, and
  // answers claims of it. Servers' reports on others count as if these were heard.
  void Handle(const exchange::Message& message);

  // `vitals` is called whenever the status is published, on that thread.
  void FeelBy(std::function<Vitals()> vitals) { vitals_ = std::move(vitals); }
  // Sets the status to be published from now on; agent, role, instance and version stay.
  void Set(exchange::AgentStatus status);
  [[nodiscard]] const exchange::AgentStatus& status() const { return status_; }
  // Publishes if the interval has passed, or if the mode or the hold has changed.
  void Tick(Clock::time_point now);
  // Publishes now.
  void Publish();

  // Returns a server that was heard and has not gone since; if there are several, the same one as
  // long as it is there.
  [[nodiscard]] const std::optional<AgentId>& server() const { return server_; }
  // Returns all of these.
  [[nodiscard]] std::set<AgentId> servers() const { return servers_.Names(); }
  // Returns that another running process has the name, if that was not found when this one started,
  // or an empty text. It is published with the status, and logged.
  [[nodiscard]] std::string NameTrouble() const;

 private:
  // kConflict means that somebody else keeps the name.
  [[nodiscard]] Result<void> See(const exchange::Message& message) const;
  // Tells a process that claims this one's name whose it is, because it did not hear the earlier
  // statuses.
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
  // Each server's report on agents that are not heard.
  struct Told {
    std::uint32_t agents = 0;
    std::uint64_t namesake = 0;  // the instance of another process of this name; 0 if there is none
  };
  std::map<AgentId, Told> told_;
  std::optional<exchange::ReachDesk> reach_;  // unless the process has one that answers already
  std::uint64_t namesake_ = 0;                // heard
  std::string name_trouble_;                  // as it was last logged
};

// Adds to a role's topics the statuses of all agents, overheard if the role does not read them, and
// servers' reports on those that are not heard, because a process must notice that its name is
// taken. It also adds the topics by which members are asked whom they hear.
[[nodiscard]] exchange::TopicUse WithAgents(exchange::TopicUse use);

}  // namespace trailcast::program
