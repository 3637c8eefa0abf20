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

// The demo's processes: one route server, the robots' agents, and a console if one is started. The
// destructor ends all of them and waits for that.
class DemoFleet {
 public:
  // Starts trailcast-server, and a trailcast-agent for each robot; both programs are in `programs`.
  [[nodiscard]] static Result<DemoFleet> Start(const std::filesystem::path& programs,
                                               const std::filesystem::path& folder,
                                               const std::vector<DemoRobot>& robots,
                                               const program::CommonOptions& network);
  // Starts a trailcast-console as well; port 0 picks any free one.
  [[nodiscard]] Result<void> StartConsole(const std::filesystem::path& programs,
                                          const std::filesystem::path& folder,
                                          const program::CommonOptions& network, int port);
  ~DemoFleet() { Stop(); }
  DemoFleet(DemoFleet&&) noexcept = default;
  DemoFleet& operator=(DemoFleet&&) noexcept = default;

  // Says whether all robots' processes have ended.
  [[nodiscard]] bool RobotsEnded();
  // Returns how robot `index` of `robots` ended, or nothing while it runs.
  [[nodiscard]] std::optional<ExitStatus> RobotStatus(std::size_t index);
  // Returns the console's address once it has one.
  [[nodiscard]] std::optional<std::string> ConsoleAddress() const;
  // Returns what makes it pointless to go on, with the last lines of the log: the server or the
  // console has ended, or a scout has without teaching.
  [[nodiscard]] std::optional<std::string> Broken();
  [[nodiscard]] std::vector<std::string> RobotLog(std::size_t index, std::size_t lines) const;

  // Asks all processes to end, and then makes sure that they do.
  void Stop();

 private:
  DemoFleet() = default;

  std::vector<ChildProcess> server_;   // exactly one
  std::vector<ChildProcess> console_;  // at most one
  std::vector<ChildProcess> robots_;   // scouts first
  std::size_t scouts_ = 0;
};

}  // namespace trailcast::demo
