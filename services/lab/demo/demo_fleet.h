#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "services/base/result.h"
#include "services/lab/demo/child_process.h"
#include "services/lab/demo/demo_plan.h"
#include "services/program/command_line.h"

namespace trailcast::demo {

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
  // What makes going on pointless: server or console have ended, or a scout did without teaching.
  // With the last lines of its log.
  [[nodiscard]] std::optional<std::string> Broken();
  [[nodiscard]] std::vector<std::string> RobotLog(std::size_t index, std::size_t lines) const;

  // Asks all to end, then sees to it.
  void Stop();

 private:
  DemoFleet() = default;

  std::vector<ChildProcess> server_;   // one
  std::vector<ChildProcess> console_;  // at most one
  std::vector<ChildProcess> robots_;   // scouts first
  std::size_t scouts_ = 0;
};

}  // namespace trailcast::demo
