#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "services/base/ids.h"
#include "services/exchange/messages.h"
#include "services/fleet/sending.h"
#include "services/fleet/telling.h"
#include "services/vda5050/graph.h"
#include "services/vda5050/order.h"
#include "services/vda5050/protocol.h"

namespace trailcast::vda5050 {

// A robot as a vehicle of VDA 5050: what it is told there becomes missions and commands, and what
// it tells becomes its state. No I/O, no clock: what is heard goes to Hear, what came from the
// broker to TakeOrder and TakeInstantActions, and what Due returns is to be published in the fleet.
class Vehicle {
 public:
  using Time = std::chrono::steady_clock::time_point;
  // In a large fleet an agent speaks every few seconds.
  static constexpr std::chrono::milliseconds kSilentAfter{10'000};
  // A command that is not answered within this has failed, and is told on if it stops the robot.
  static constexpr std::chrono::milliseconds kAnswerWithin{5'000};
  // A server that cannot hand a mission over by then drops it.
  static constexpr std::uint32_t kValidFor_s = 60;

  // `client` sends missions. `battery` is told of a robot that tells none.
  Vehicle(Identity identity, AgentId client, std::optional<std::uint8_t> battery);

  // Takes everything that is heard in the fleet, of other robots as well.
  void Hear(const exchange::Message& message, Time now);
  // `graph` is null while no server has told its network.
  void TakeOrder(std::string_view payload, const Graph* graph, Time now);
  void TakeInstantActions(std::string_view payload, Time now);
  // Reports that a message was not taken at all.
  void Refuse(Fault fault) { rejected_ = std::move(fault); }
  // Notes the words in which a server says that it charges; an empty text if none does.
  void NoteCharging(std::string words) { charging_ = std::move(words); }
  // Sends the robot on along what is released, and notes what it has reached.
  void Tick(const Graph* graph, Time now);
  // Returns what is to be published now, again and again.
  [[nodiscard]] std::vector<exchange::Message> Due(Time now);

  [[nodiscard]] const Identity& identity() const { return identity_; }
  [[nodiscard]] Connection ConnectionAt(Time now) const;
  // The state needs a battery, and none is made up.
  [[nodiscard]] bool tells_battery() const {
    return status_.battery_percent.has_value() || battery_.has_value();
  }
  // Returns the message on the topic `state` without its header.
  [[nodiscard]] nlohmann::ordered_json State(Time now) const;
  // Returns the same without what changes all the time, and is no reason to tell it at once.
  [[nodiscard]] nlohmann::ordered_json Events(Time now) const;
  // Says whether it was asked for since the last call.
  [[nodiscard]] bool TakeStateRequest() { return std::exchange(state_asked_, false); }
  [[nodiscard]] bool TakeFactsheetRequest() { return std::exchange(factsheet_asked_, false); }

 private:
  struct Held {
    Order order{};       // the steps of all its updates, the horizon of the last
    std::size_t at = 0;  // the node that was reached last
    bool active = true;
    bool cancelled = false;
  };
  // A mission along released nodes.
  struct Leg {
    struct Mark {
      std::size_t node = 0;
      double driven_m = 0.0;  // from the leg's beginning
    };
    fleet::Sending sending;
    Time began{};
    Time say_at{};
    std::vector<network::Section> sections{};
    std::vector<std::uint32_t> tasks{};  // of the mission, one for each section
    std::vector<Mark> marks{};
    std::size_t on = 0;      // the section that it is on
    double driven_m = 0.0;   // from the leg's beginning
    double from_m = 0.0;     // the last node, by the same measure
    bool withdrawn = false;  // the order is being cancelled
  };
  struct Command {
    std::string action{};  // its id; empty where nobody asked for it
    exchange::NowOrder order = exchange::NowOrder::kPause;
    fleet::Telling telling;
    Time began{};
    Time say_at{};
    bool failed = false;
  };
  struct ActionState {
    Action action{};
    std::string status{};
    std::string result{};
  };
  enum class Mode : std::uint8_t { kStartup, kAutomatic, kManual, kService, kTeachIn };

  [[nodiscard]] AgentId robot() const { return AgentId(identity_.serial); }
  [[nodiscard]] Mode ModeNow() const;
  [[nodiscard]] bool IsActive() const { return held_ && held_->active; }
  [[nodiscard]] bool Drives() const;
  [[nodiscard]] bool IsPaused() const;
  [[nodiscard]] std::size_t LastReleased() const;

  void On(const exchange::AgentStatus& status, Time now);
  void On(const mission::Report& report, Time now);
  void On(const exchange::MissionReply& reply, Time now);
  [[nodiscard]] bool IsOwn(const std::string& mission) const;

  [[nodiscard]] std::optional<Fault> TakeNew(Order order, const Graph* graph);
  [[nodiscard]] std::optional<Fault> TakeUpdate(Order order, const Graph* graph);
  [[nodiscard]] std::optional<Fault> CheckNodes(const Order& order, const Graph* graph) const;
  void Accepted();

  void Begin(const Action& action, Time now);
  void BeginCancel(const Action& action, Time now);
  void Tell(const std::string& action, exchange::NowOrder order, Time now);
  void SeeTo(Time now);
  [[nodiscard]] bool SeeTo(Command& command, Time now);
  void Obeyed(const Command& command, const std::string& detail);
  void NotObeyed(Command& command, const std::string& why);
  [[nodiscard]] bool RobotHasLeg() const;
  void EndOrder();
  void ClearActions();
  void Conclude(const std::string& action, const char* status, const std::string& result);

  void Progress();
  void EndLeg(const mission::Report& last);
  void BeginLeg(const Graph& graph, Time now);
  void NoteReached(std::size_t node);

  [[nodiscard]] std::vector<Fault> Faults(Time now) const;
  void AddOrderState(nlohmann::ordered_json& state) const;

  Identity identity_;
  AgentId client_;
  std::optional<std::uint8_t> battery_;
  exchange::AgentStatus status_{};
  bool heard_ = false;
  bool gone_ = false;
  Time heard_at_{};
  std::optional<network::Place> stood_{};  // where it said last that it stands
  std::string charging_{};                 // in a server's words; empty: none says so
  std::string foreign_{};                  // the mission that it does for somebody else

  std::optional<Held> held_{};
  std::optional<Leg> leg_{};
  std::deque<std::string> own_{};  // missions, the newest last
  std::string last_node_{};        // empty: not known
  std::vector<Command> commands_{};
  std::deque<ActionState> actions_{};
  bool state_asked_ = false;
  bool factsheet_asked_ = false;

  std::optional<Fault> rejected_{};  // the last message that was not taken
  std::optional<Fault> rejected_action_{};
  std::optional<Fault> no_cancel_{};
  std::optional<Fault> disobeyed_{};
  std::optional<Fault> unreachable_{};  // why the robot does not go on
  std::string lost_{};                  // in its words; empty: it is not lost
};

}  // namespace trailcast::vda5050
