#pragma once

#include <chrono>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "services/base/result.h"
#include "services/lab/demo/child_process.h"
#include "services/lab/demo/demo_plan.h"
#include "services/lab/demo/fleet_view.h"
#include "services/lab/demo/journey_report.h"
#include "services/program/command_line.h"

namespace trailcast::demo {

// The operator of `trailcast demo --network`: joins what the scouts have taught, sends all robots
// to one place, and closes a part of the way while they drive. By the commands that one types, each
// a process of its own.
class NetworkShow {
 public:
  using Time = std::chrono::steady_clock::time_point;
  NetworkShow(std::filesystem::path programs, std::filesystem::path folder,
              const program::CommonOptions& network, const NetworkPlan& plan);

  // Takes in whatever is heard. The main thread calls this, as all of this class.
  void Hear(const std::vector<exchange::Message>& messages);
  // As far as it can go now; from the main thread. An error: a command that failed, and what it
  // said.
  [[nodiscard]] Result<void> Step(const FleetView& view, Time now);
  // All robots' journeys have ended, one way or another.
  [[nodiscard]] bool over() const { return stage_ == Stage::kOver; }
  // What was typed, each with the line it was answered with last.
  [[nodiscard]] const std::vector<std::string>& typed() const { return typed_; }
  // Tells how each journey ended, in the plan's order.
  [[nodiscard]] std::vector<JourneyEnd> Ends() const;

 private:
  enum class Stage { kTaught, kProposals, kJoin, kSend, kClose, kWait, kOver };

  [[nodiscard]] Result<ChildProcess> Type(const std::vector<std::string>& words, bool shown);
  // Whether the command that is running has ended well; an error if it has ended otherwise.
  [[nodiscard]] Result<bool> Done();
  void TakeAnswer(Time now);
  [[nodiscard]] Result<void> TypeNext();
  [[nodiscard]] Result<void> SendAll();
  [[nodiscard]] bool AllTaught(const FleetView& view) const;
  // Who was carried to where no way leads on may wait for one.
  [[nodiscard]] bool AllEnded(Time now);
  [[nodiscard]] std::optional<mission::Report> ReportOf(std::size_t journey) const;

  std::filesystem::path programs_;
  std::filesystem::path folder_;
  program::CommonOptions network_;
  const NetworkPlan& plan_;
  Stage stage_ = Stage::kTaught;
  std::vector<std::vector<std::string>> to_type_;  // one after the other
  std::optional<ChildProcess> running_;
  std::vector<ChildProcess> sends_;
  std::map<AgentId, mission::Report> reports_;  // the last of each robot
  std::vector<std::string> typed_;
  Time proposals_until_{};
  std::optional<Time> waits_since_{};
  int logs_ = 0;
};

}  // namespace trailcast::demo
