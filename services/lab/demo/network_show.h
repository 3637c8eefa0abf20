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

// The operator of `trailcast demo --network`. It joins the scouts' routes, sends all robots to one
// place, and closes a section of the path while they drive. It uses the commands that people type,
// each in a process of its own.
class NetworkShow {
 public:
  using Time = std::chrono::steady_clock::time_point;
  NetworkShow(std::filesystem::path programs, std::filesystem::path folder,
              const program::CommonOptions& network, const NetworkPlan& plan);

  // Takes all messages. The main thread makes all calls of this class.
  void Hear(const std::vector<exchange::Message>& messages);
  // Goes as far as it can now. An error is a command that failed, with its message.
  [[nodiscard]] Result<void> Step(const FleetView& view, Time now);
  // Says whether all robots' journeys have ended, in whatever way.
  [[nodiscard]] bool over() const { return stage_ == Stage::kOver; }
  // Returns the commands, each with the last line of its answer.
  [[nodiscard]] const std::vector<std::string>& typed() const { return typed_; }
  // Returns how each journey ended, in the plan's order.
  [[nodiscard]] std::vector<JourneyEnd> Ends() const;

 private:
  enum class Stage { kTaught, kProposals, kJoin, kSend, kClose, kWait, kOver };

  [[nodiscard]] Result<ChildProcess> Type(const std::vector<std::string>& words, bool shown);
  // Says whether the running command has ended well; it is an error if it has ended otherwise.
  [[nodiscard]] Result<bool> Done();
  void TakeAnswer(Time now);
  [[nodiscard]] Result<void> TypeNext();
  [[nodiscard]] Result<void> SendAll();
  [[nodiscard]] bool AllTaught(const FleetView& view) const;
  // A robot that was carried to a place without a path may wait for one.
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
  std::map<AgentId, mission::Report> reports_;  // each robot's last one
  std::vector<std::string> typed_;
  Time proposals_until_{};
  std::optional<Time> waits_since_{};
  int logs_ = 0;
};

}  // namespace trailcast::demo
