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
#include "services/exchange/servers_there.h"
#include "services/mission/orders.h"

namespace trailcast::agent {

// Handles the missions that this robot is sent. It takes one at a time, once however often it
// comes, and reports its state until a server has that. It corrects a server that has a mission in
// another state. A mission that this robot does not know has failed. Everything is in a file, so
// that neither is forgotten however the agent ends. Where a server keeps missions in queues, this
// robot takes one when that server hands it over. It has no clock of its own.
class MissionHandler {
 public:
  using Time = std::chrono::steady_clock::time_point;
  // The last so many are remembered. One that was sent before these, and comes again, is taken for
  // a new one.
  static constexpr std::size_t kMostKept = 64;
  // A mission that came this often, while no server has said that it keeps it, is taken without
  // one.
  static constexpr int kSentInVain = 10;

  MissionHandler(AgentId self, std::filesystem::path file)
      : self_(std::move(self)), file_(std::move(file)) {}

  // Loads what an earlier run has left. kCorrupt means that another program wrote to the file.
  [[nodiscard]] Result<void> Load();

  void Handle(const exchange::Message& message);

  struct Current {
    mission::Mission mission{};
    std::vector<mission::Task> tasks{};
    std::uint32_t task = 0;  // the one to be done
    std::uint32_t lap = 0;   // and its laps already done
    bool begun = false;      // an earlier run has begun it
    mission::Going going{};  // without a destination if it was sent along routes by hand
    mission::PhotoWish photos{};
    [[nodiscard]] mission::Task::Kind kind() const { return tasks[task].kind; }
  };
  // Returns the mission to be done, or none if the robot is free.
  [[nodiscard]] const std::optional<Current>& current() const { return current_; }

  // Says whether a server is there that keeps missions for robots.
  [[nodiscard]] bool has_keeper() const { return !keepers_.empty(); }

  // Says whether, since the last call, a server has sent another path to the current mission's
  // destination (mission::Going). Its tasks then begin from the first, or from the one that GoOnAt
  // names.
  [[nodiscard]] bool TakeAmended() { return std::exchange(amended_, false); }
  void GoOnAt(std::uint32_t task);
  // Notes where the robot stands when it begins the present task.
  void BeginAt(double along_m) { current_->tasks[current_->task].from_m = along_m; }

  // Reports the current mission's state; a mission that has ended is no longer current.
  void Tell(mission::State state, const std::string& detail = {},
            mission::WaitsFor waits_for = mission::WaitsFor::kNothing);
  // Notes that a lap of its task is done, or the task as a whole.
  void NoteDone();

  // Returns messages to publish: news, and again and again what no server has, while one is there.
  [[nodiscard]] std::vector<exchange::Message> Due(Time now, bool server_there);
  // Returns lines for the log.
  [[nodiscard]] std::vector<std::string> TakeNews() { return std::exchange(news_, {}); }

 private:
  struct Kept {
    mission::Mission mission{};
    mission::Report last{};
    std::uint32_t lap = 0;
    bool confirmed = false;  // a server has repeated it
    bool due = true;         // to be sent once more, whether or not a server is there
  };

  void Take(const mission::Mission& mission);
  // Says whether a server is to hand the mission over when its turn has come.
  [[nodiscard]] bool IsServers(const mission::Mission& mission);
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
  // The final reports on missions that servers take to be under way here, but that this robot does
  // not know.
  std::map<std::string, mission::Report> unknown_;
  exchange::ServersThere keepers_;  // the servers that keep missions
  // How often each mission came that no server has said it keeps, by its id.
  std::map<std::string, int> unkept_;
  Time again_at_{};
  std::vector<std::string> news_;
};

}  // namespace trailcast::agent
