#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "services/base/result.h"
#include "services/demo/child_process.h"
#include "services/program/command_line.h"

namespace trailcast::demo {

inline constexpr const char* kDemoRoute = "demo";
inline constexpr const char* kDemoWorld = "indoor";
// Of robots on duty: it ends where it begins, so that they can be sent again and again.
inline constexpr const char* kRoundRoute = "round";

// One robot of the demo: what it is, and where its process leaves what it knows.
struct DemoRobot {
  enum class Task { kTeach, kFollow, kOnDuty };
  std::string name;
  std::string camera;       // for people
  std::string camera_word;  // for trailcast-agent: a built-in one or a camera file
  std::uint64_t seed = 0;
  Task task = Task::kFollow;
  std::string route = kDemoRoute;  // that it teaches or follows
  std::filesystem::path path;      // way-points; empty: the world's own
  std::filesystem::path truth;     // CSV of true poses, written at the end
  std::filesystem::path report;    // key=value lines, written at the end

  [[nodiscard]] bool is_scout() const { return task == Task::kTeach; }
};

// The scout first, then the followers; files in `folder`, where their camera files are written too.
[[nodiscard]] Result<std::vector<DemoRobot>> PlanRobots(const std::filesystem::path& folder,
                                                        std::uint64_t seed);
// The scout of kRoundRoute first, then robots on duty at its beginning.
[[nodiscard]] Result<std::vector<DemoRobot>> PlanDuty(const std::filesystem::path& folder,
                                                      std::uint64_t seed);

// The demo's processes: one route server, the robots' agents, and a console where one is started.
// All are ended, and waited for, when this goes.
class DemoFleet {
 public:
  // Starts trailcast-server and a trailcast-agent for each robot; both programs lie in `programs`.
  [[nodiscard]] static Result<DemoFleet> Start(const std::filesystem::path& programs,
                                               const std::filesystem::path& folder,
                                               const std::vector<DemoRobot>& robots,
                                               const program::CommonOptions& network);
  // Besides them a trailcast-console; port 0: any that is free.
  [[nodiscard]] Result<void> StartConsole(const std::filesystem::path& programs,
                                          const std::filesystem::path& folder,
                                          const program::CommonOptions& network, int port);
  ~DemoFleet() { Stop(); }
  DemoFleet(DemoFleet&&) noexcept = default;
  DemoFleet& operator=(DemoFleet&&) noexcept = default;

  // All robots' processes have ended.
  [[nodiscard]] bool RobotsEnded();
  // How robot `index` of `robots` ended, or nothing while it runs.
  [[nodiscard]] std::optional<ExitStatus> RobotStatus(std::size_t index);
  // Where the console is to be found, once it is.
  [[nodiscard]] std::optional<std::string> ConsoleAddress() const;
  // What makes going on pointless: server or console have ended, or the scout did without teaching.
  // With the last lines of its log.
  [[nodiscard]] std::optional<std::string> Broken();
  [[nodiscard]] std::vector<std::string> RobotLog(std::size_t index, std::size_t lines) const;

  // Asks all to end, then sees to it.
  void Stop();

 private:
  DemoFleet() = default;

  std::vector<ChildProcess> server_;   // one
  std::vector<ChildProcess> console_;  // at most one
  std::vector<ChildProcess> robots_;
};

}  // namespace trailcast::demo
