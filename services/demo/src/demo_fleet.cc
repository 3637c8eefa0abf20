#include "services/demo/demo_fleet.h"

#include <fmt/format.h>

#include <chrono>
#include <fstream>

#include "services/sim/core/random.h"

namespace trailcast::demo {
namespace {

constexpr auto kEndBound = std::chrono::milliseconds(5000);
constexpr std::size_t kLogLines = 8;
// A follower waits for the route from the moment it starts until the scout has driven two metres.
constexpr const char* kWait_s = "120";

// The scout's make of camera, on another robot: higher up, and looking a little aside and up.
constexpr const char* kOtherMount =
    "name = \"webcam, other mount\"\nwidth = 320\nheight = 240\nmodel = \"pinhole\"\n"
    "hfov_deg = 60.0\ndistortion = 0.10\nheight_m = 0.42\nyaw_deg = 2.0\npitch_deg = 2.0\n";

Result<std::filesystem::path> WriteOtherMount(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / "webcam-other-mount.toml";
  std::ofstream out(file);
  out << kOtherMount;
  out.close();
  if (!out) return Fail(ErrorCode::kUnavailable, "cannot write {}", file.string());
  return file;
}

std::vector<std::string> NetworkWords(const program::CommonOptions& network,
                                      const std::string& name) {
  return {"--name",
          name,
          "--domain",
          std::to_string(network.domain),
          "--dds-tag",
          network.dds_tag,
          "--log-level",
          network.log_level,
          "--network-interface",
          network.network_interface,
          "--discovery",
          network.discovery,
          "--security",
          network.security};
}

std::vector<std::string> AgentWords(const std::string& program, const DemoRobot& robot,
                                    const std::filesystem::path& folder,
                                    const program::CommonOptions& network) {
  std::vector<std::string> words{program};
  for (std::string& word : NetworkWords(network, robot.name)) words.push_back(std::move(word));
  const std::vector<std::string> what{"--server",
                                      "--store",
                                      (folder / (robot.name + ".db")).string(),
                                      "--report",
                                      robot.report.string(),
                                      robot.scout ? "teach" : "replay",
                                      "--route",
                                      kDemoRoute,
                                      "--sim",
                                      kDemoWorld,
                                      "--camera",
                                      robot.camera_word,
                                      "--seed",
                                      std::to_string(robot.seed),
                                      "--sim-truth",
                                      robot.truth.string()};
  words.insert(words.end(), what.begin(), what.end());
  if (!robot.scout) {
    // Each of them has the laboratory to itself: nobody is in anybody's way.
    for (const char* word : {"--wait-for-route", "--wait", kWait_s, "--keep-distance", "0"}) {
      words.emplace_back(word);
    }
  }
  return words;
}

std::string WithLog(std::string what, const ChildProcess& process) {
  for (const std::string& line : LastLines(process.log(), kLogLines)) what += "\n    " + line;
  return what;
}

}  // namespace

Result<std::vector<DemoRobot>> PlanRobots(const std::filesystem::path& folder, std::uint64_t seed) {
  const auto other_mount = WriteOtherMount(folder);
  if (!other_mount) return tl::unexpected(other_mount.error());
  std::vector<DemoRobot> robots(4);
  robots[0] = {"scout", "webcam", "webcam", 0, true, {}, {}};
  robots[1] = {"follower-1", "webcam, moved", other_mount->string(), 0, false, {}, {}};
  robots[2] = {"follower-2", "firewire", "firewire", 0, false, {}, {}};
  robots[3] = {"follower-3", "wide", "wide", 0, false, {}, {}};
  for (DemoRobot& robot : robots) {
    // 63 bits: what a TOML file or another program can hold as well.
    robot.seed = sim::Random(seed, robot.name).Bits() >> 1U;
    robot.truth = folder / (robot.name + "-truth.csv");
    robot.report = folder / (robot.name + "-report.txt");
  }
  return robots;
}

Result<DemoFleet> DemoFleet::Start(const std::filesystem::path& programs,
                                   const std::filesystem::path& folder,
                                   const std::vector<DemoRobot>& robots,
                                   const program::CommonOptions& network) {
  DemoFleet fleet;
  std::vector<std::string> words{(programs / "trailcast-server").string()};
  for (std::string& word : NetworkWords(network, "server")) words.push_back(std::move(word));
  words.insert(words.end(), {"--store", (folder / "server.db").string()});
  auto server = ChildProcess::Start(words, folder / "server.log");
  if (!server) return tl::unexpected(server.error());
  fleet.server_.push_back(std::move(*server));
  const std::string program = (programs / "trailcast-agent").string();
  for (const DemoRobot& robot : robots) {
    auto agent = ChildProcess::Start(AgentWords(program, robot, folder, network),
                                     folder / (robot.name + ".log"));
    if (!agent) return tl::unexpected(agent.error());
    fleet.robots_.push_back(std::move(*agent));
  }
  return fleet;
}

bool DemoFleet::RobotsEnded() {
  bool ended = true;
  for (ChildProcess& robot : robots_) ended = robot.Poll().has_value() && ended;
  return ended;
}

std::optional<ExitStatus> DemoFleet::RobotStatus(std::size_t index) {
  return robots_[index].Poll();
}

std::optional<std::string> DemoFleet::Broken() {
  if (const auto status = server_.front().Poll()) {
    return WithLog(fmt::format("the route server {}; its last words:", ToString(*status)),
                   server_.front());
  }
  const auto scout = robots_.front().Poll();
  if (scout && !scout->ok()) {
    return WithLog(fmt::format("the scout {}; its last words:", ToString(*scout)), robots_.front());
  }
  return std::nullopt;
}

std::vector<std::string> DemoFleet::RobotLog(std::size_t index, std::size_t lines) const {
  return LastLines(robots_[index].log(), lines);
}

void DemoFleet::Stop() {
  for (ChildProcess& robot : robots_) robot.Terminate();
  for (ChildProcess& server : server_) server.Terminate();
  for (ChildProcess& robot : robots_) robot.Reap(kEndBound);
  for (ChildProcess& server : server_) server.Reap(kEndBound);
}

}  // namespace trailcast::demo
