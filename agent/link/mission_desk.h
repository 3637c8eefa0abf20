#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "services/base/ids.h"
#include "services/base/result.h"
#include "services/exchange/messages.h"
#include "services/mission/orders.h"

namespace trailcast::agent {

// What this robot is sent to do: takes a mission at a time, once however often it comes, and says
// what became of it until a server has that. A server that takes a mission to be as it is not is
// answered; what this robot knows nothing of has failed. All of it is in a file, so that neither is
// forgotten when the agent ends in whatever way. No clock of its own.
class MissionDesk {
 public:
  using Time = std::chrono::steady_clock::time_point;
  // The last are remembered: one that was sent before those, and comes once more, is a new one.
  static constexpr std::size_t kMostKept = 64;

  MissionDesk(AgentId self, std::filesystem::path file)
      : self_(std::move(self)), file_(std::move(file)) {}

  // What an earlier run has left. kCorrupt: somebody else wrote to the file.
  [[nodiscard]] Result<void> Load();

  void Handle(const exchange::Message& message);

  struct Current {
    mission::Mission mission{};
    std::vector<mission::Task> tasks{};
    std::uint32_t task = 0;  // which of these is to be done,
    std::uint32_t lap = 0;   // and what of its laps is done
    bool begun = false;      // an earlier run was at it
    mission::Going going{};  // to nowhere: it is sent along routes by hand
    [[nodiscard]] mission::Task::Kind kind() const { return tasks[task].kind; }
  };
  // What is to be done; none: the robot is free.
  [[nodiscard]] const std::optional<Current>& current() const { return current_; }

  // Whether a server has sent another way to where the current one leads (mission::Going), since
  // this was asked last: its tasks are to be done from their beginning, or from there on.
  [[nodiscard]] bool TakeAmended() { return std::exchange(amended_, false); }
  void GoOnAt(std::uint32_t task);
  // The robot stands there when it begins the task that is to be done.
  void BeginAt(double along_m) { current_->tasks[current_->task].from_m = along_m; }

  // Of the current one. What has ended is no longer current.
  void Tell(mission::State state, const std::string& detail = {},
            mission::WaitsFor waits_for = mission::WaitsFor::kNothing);
  // A lap of its task is done, or the task as a whole.
  void NoteDone();

  // To be published: what is new; and what no server has, again and again while one is there.
  [[nodiscard]] std::vector<exchange::Message> Due(Time now, bool server_there);
  // A line each for the log.
  [[nodiscard]] std::vector<std::string> TakeNews() { return std::exchange(news_, {}); }

 private:
  struct Kept {
    mission::Mission mission{};
    mission::Report last{};
    std::uint32_t lap = 0;
    bool confirmed = false;  // a server has said the same
    bool due = true;         // to be said once more, whoever is there
  };

  void Take(const mission::Mission& mission);
  void Amend(Kept& kept, const mission::Mission& mission);
  void Compare(const mission::Report& report);
  [[nodiscard]] Kept* Find(const std::string& id);
  [[nodiscard]] Kept& CurrentKept();
  void Answer(Kept& kept, mission::State state, const std::string& detail,
              mission::WaitsFor waits_for = mission::WaitsFor::kNothing);
  void Begin(const Kept& kept, std::vector<mission::Task> tasks);
  [[nodiscard]] Result<void> Keep() const;
  void KeepOrSay();

  AgentId self_;
  std::filesystem::path file_;
  std::deque<Kept> kept_;  // the newest last
  std::optional<Current> current_;
  bool amended_ = false;
  // Missions that servers take to be under way here, and of which nothing is known: their end.
  std::map<std::string, mission::Report> unknown_;
  Time again_at_{};
  std::vector<std::string> news_;
};

}  // namespace trailcast::agent
