#include "services/lab/demo/demo_fleet.h"

#include <fmt/format.h>

#include <chrono>

#include "services/lab/demo/src/network_words.h"

namespace trailcast::demo {
namespace {

constexpr auto kEndBound = std::chrono::milliseconds(5000);
constexpr std::size_t kLogLines = 8;
constexpr const char* kLogs = "logs";  // for the robots that are sent on missions
// A follower waits for the route from its start until the scout has driven two metres. A robot on a
// mission may be faster than the scout that teaches its route.
constexpr const char* kWait_s = "120";

std::vector<std::string> AgentWords(const std::string& program, const DemoRobot& robot,
                                    const std::filesystem::path& folder,
                                    const program::CommonOptions& network) {
  using Task = DemoRobot::Task;
  std::vector<std::string> words{program};
  const auto add = [&](const std::vector<std::string>& more) {
    words.insert(words.end(), more.begin(), more.end());
  };
  add(NetworkWords(network, robot.name));
  add({"--server", "--store", (folder / (robot.name + ".db")).string(), "--report",
       robot.report.string()});
  switch (robot.task) {
    case Task::kTeach:
      add({"teach", "--route", robot.route});
      break;
    case Task::kFollow:
      add({"replay", "--route", robot.route, "--wait-for-route"});
      break;
    case Task::kOnDuty:
      add({"serve", "--logs", (folder / kLogs / robot.name).string()});
      break;
  }
  add({"--sim", kDemoWorld, "--camera", robot.camera_word, "--seed", std::to_string(robot.seed),
       "--sim-truth", robot.truth.string()});
  if (!robot.path.empty()) add({"--path", robot.path.string()});
  if (!robot.carry.empty()) add({"--sim-carry", robot.carry});
  // Each of them has the laboratory to itself, so nobody is in anybody's way.
  if (robot.task != Task::kTeach) add({"--wait", kWait_s, "--keep-distance", "0"});
  return words;
}

std::string WithLog(std::string what, const ChildProcess& process) {
  for (const std::string& line : LastLines(process.log(), kLogLines)) what += "\n    " + line;
  return what;
}

}  // namespace

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
    if (robot.is_scout()) ++fleet.scouts_;
  }
  return fleet;
}

Result<void> DemoFleet::StartConsole(const std::filesystem::path& programs,
                                     const std::filesystem::path& folder,
                                     const program::CommonOptions& network, int port) {
  std::error_code failed;
  std::filesystem::create_directories(folder / kLogs, failed);
  if (failed) return Fail(ErrorCode::kUnavailable, "cannot make {}", (folder / kLogs).string());
  std::vector<std::string> words{(programs / "trailcast-console").string()};
  program::CommonOptions everybody = network;
  everybody.discovery = "mesh";  // the console's usual mode
  for (std::string& word : NetworkWords(everybody, "console")) words.push_back(std::move(word));
  words.insert(words.end(),
               {"--http-port", std::to_string(port), "--logs", (folder / kLogs).string(),
                "--alerts", (folder / "alerts.json").string()});
  auto console = ChildProcess::Start(words, folder / "console.log");
  if (!console) return tl::unexpected(console.error());
  console_.push_back(std::move(*console));
  return {};
}

std::optional<std::string> DemoFleet::ConsoleAddress() const {
  if (console_.empty()) return std::nullopt;
  for (const std::string& line : LastLines(console_.front().log(), kLogLines)) {
    const std::size_t begin = line.find("http://localhost:");
    if (begin == line.npos) continue;
    const std::size_t end = line.find_first_not_of("0123456789", begin + 17);
    return line.substr(begin, end == line.npos ? end : end - begin);
  }
  return std::nullopt;
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
  for (ChildProcess& console : console_) {
    if (const auto status = console.Poll()) {
      return WithLog(fmt::format("the console {} (--http-port takes another port); its last words:",
                                 ToString(*status)),
                     console);
    }
  }
  for (std::size_t i = 0; i < scouts_; ++i) {
    const auto scout = robots_[i].Poll();
    if (scout && !scout->ok()) {
      return WithLog(fmt::format("the scout {}; its last words:", ToString(*scout)), robots_[i]);
    }
  }
  return std::nullopt;
}

std::vector<std::string> DemoFleet::RobotLog(std::size_t index, std::size_t lines) const {
  return LastLines(robots_[index].log(), lines);
}

void DemoFleet::Stop() {
  for (auto* processes : {&robots_, &console_, &server_}) {
    for (ChildProcess& process : *processes) process.Terminate();
  }
  for (auto* processes : {&robots_, &console_, &server_}) {
    for (ChildProcess& process : *processes) process.Reap(kEndBound);
  }
}

}  // namespace trailcast::demo
