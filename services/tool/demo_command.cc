#include <unistd.h>

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <limits>
#include <memory>
#include <random>
#include <string>
#include <system_error>
#include <vector>

#include "services/base/work_folder.h"
#include "services/demo/demo_dispatch.h"
#include "services/demo/demo_fleet.h"
#include "services/demo/demo_report.h"
#include "services/demo/fleet_view.h"
#include "services/exchange/publish.h"
#include "services/fleet/operator_peer.h"
#include "services/program/live_lines.h"
#include "services/program/open_exchange.h"
#include "services/program/stop_signal.h"
#include "services/sim/places/indoor_world.h"
#include "services/tool/command.h"
#include "services/trial/trial_plot.h"

namespace trailcast::tool {
namespace {

using Clock = std::chrono::steady_clock;

struct DemoOptions {
  std::uint64_t seed = 1;
  std::filesystem::path out = ".";
  bool keep = false;
  double timeout_s = 600.0;
  bool console = false;
  int http_port = 8080;
};

constexpr const char* kPicture = "trailcast-demo.png";
constexpr auto kTakeWait = std::chrono::milliseconds(100);
// After the last process has ended its last status may still be on its way.
constexpr auto kLastWords = std::chrono::milliseconds(300);
constexpr int kExitInterrupted = 130;
constexpr std::size_t kLogLines = 8;

constexpr const char* kExamples =
    "Examples:\n"
    "  trailcast demo\n"
    "  trailcast demo --seed 7 --out /tmp\n"
    "  trailcast demo --keep            # leaves logs, stores and true poses to look at\n"
    "  trailcast demo --console         # robots on duty: sent, seen and stopped in a browser\n"
    "Exit status: 0 all arrived (with --console: ended by Ctrl-C), 3 some did not,\n"
    "130 interrupted, 1 failed, 2 wrong usage.";

// Nobody else's: other demos and real robots on this machine do not see it.
program::CommonOptions PrivateNetwork(const program::CommonOptions& common) {
  program::CommonOptions network = common;
  std::random_device random;
  network.dds_tag = fmt::format("demo-{:08x}{:08x}", random(), random());
  network.network_interface = "lo";
  network.name = "operator";
  network.security.clear();
  return network;
}

Result<std::filesystem::path> ProgramFolder() {
  std::error_code error;
  const auto self = std::filesystem::read_symlink("/proc/self/exe", error);
  if (error) return Fail(ErrorCode::kInternal, "cannot find this program: {}", error.message());
  return self.parent_path();
}

enum class Watched { kEnded, kInterrupted, kBroken, kTooLong };

struct WatchOptions {
  double timeout_s = std::numeric_limits<double>::infinity();
  std::function<std::string(double)> headline;  // of so many seconds
  std::function<void(const std::vector<exchange::Message>&)> hear =
      [](const std::vector<exchange::Message>&) {};
};

// Watches the fleet until its robots have ended or there is a reason to stop.
class Watch {
 public:
  Watch(demo::DemoFleet& fleet, const std::vector<demo::DemoRobot>& robots,
        exchange::RouteExchange& exchange, WatchOptions options)
      : fleet_(fleet),
        robots_(robots),
        exchange_(exchange),
        options_(std::move(options)),
        live_(stdout) {}

  Watched Run() {
    const auto began = Clock::now();
    Watched result = Watched::kEnded;
    while (!fleet_.RobotsEnded()) {
      const double elapsed_s = std::chrono::duration<double>(Clock::now() - began).count();
      Take(kTakeWait);
      live_.Show(Lines(elapsed_s));
      if (program::StopSignal::requested()) return Watched::kInterrupted;
      const auto broken = fleet_.Broken();
      if (broken) {
        std::fputs((*broken + "\n").c_str(), stderr);
        return Watched::kBroken;
      }
      if (elapsed_s > options_.timeout_s) {
        result = Watched::kTooLong;
        break;
      }
    }
    Take(kLastWords);
    live_.Show(Lines(std::chrono::duration<double>(Clock::now() - began).count()), true);
    return result;
  }

 private:
  void Take(std::chrono::milliseconds max_wait) {
    const std::vector<exchange::Message> messages = exchange_.Take(max_wait);
    for (const exchange::Message& message : messages) view_.Handle(message);
    options_.hear(messages);
  }
  std::vector<std::string> Lines(double elapsed_s) const {
    std::vector<std::string> lines{options_.headline(elapsed_s)};
    for (const demo::DemoRobot& robot : robots_) {
      lines.push_back(demo::StatusLine(robot.name, robot.camera, view_.Find(AgentId(robot.name))));
    }
    return lines;
  }

  demo::DemoFleet& fleet_;
  const std::vector<demo::DemoRobot>& robots_;
  exchange::RouteExchange& exchange_;
  WatchOptions options_;
  demo::FleetView view_;
  program::LiveLines live_;
};

Result<void> DrawPicture(const std::vector<demo::DemoRow>& rows,
                         const std::filesystem::path& file) {
  const auto world = sim::MakeIndoorWorld();
  if (!world) return tl::unexpected(world.error());
  plot::Plan plan;
  plan.title = "trailcast demo: one scout teaches, three other cameras follow";
  plan.paths = demo::DemoPaths(rows);
  plan.backdrop = trial::WorldBackdrop(*world->world, plan.paths);
  return plot::DrawPlan(plan).Write(file);
}

// Table and picture, from what the processes left in their files.
Result<int> Report(demo::DemoFleet& fleet, const std::vector<demo::DemoRobot>& robots,
                   const DemoOptions& options) {
  std::vector<std::optional<demo::ExitStatus>> ended;
  for (std::size_t i = 0; i < robots.size(); ++i) ended.push_back(fleet.RobotStatus(i));
  fleet.Stop();
  const std::vector<demo::DemoRow> rows = demo::JudgeDemo(robots, ended);
  std::fputs(("\n" + demo::DemoTable(rows)).c_str(), stdout);
  bool all = true;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    all = all && rows[i].arrived;
    if (rows[i].arrived) continue;
    fmt::print("last words of {}:\n", robots[i].name);
    for (const std::string& line : fleet.RobotLog(i, kLogLines)) fmt::print("    {}\n", line);
  }
  const std::filesystem::path picture = options.out / kPicture;
  const auto drawn = DrawPicture(rows, picture);
  if (!drawn) return tl::unexpected(drawn.error());
  fmt::print("The paths, seen from above: {}\n", picture.string());
  return all ? program::kExitOk : program::kExitNotArrived;
}

// Robots that arrive: a picture and a table, then it is over.
Result<int> ShowArrivals(demo::DemoFleet& fleet, const std::vector<demo::DemoRobot>& robots,
                         const program::CommonOptions& network, const DemoOptions& options) {
  const auto exchange = program::OpenExchange(network, exchange::ObserverTopics());
  if (!exchange) return tl::unexpected(exchange.error());
  WatchOptions watch;
  watch.timeout_s = options.timeout_s;
  watch.headline = [](double elapsed_s) {
    return fmt::format("{:.0f} s: a scout teaches, three robots with other cameras follow",
                       elapsed_s);
  };
  switch (Watch(fleet, robots, **exchange, std::move(watch)).Run()) {
    case Watched::kInterrupted:
      std::fputs("interrupted: ending the robots\n", stderr);
      return kExitInterrupted;
    case Watched::kBroken:
      return program::kExitFailure;
    case Watched::kTooLong:
      fmt::print(stderr, "still under way after {:.0f} s: giving up (--timeout)\n",
                 options.timeout_s);
      [[fallthrough]];
    case Watched::kEnded:
      return Report(fleet, robots, options);
  }
  return program::kExitFailure;
}

// Robots on duty and a console, until somebody ends it; some are sent at once, so that there is
// something to see.
Result<int> ShowConsole(demo::DemoFleet& fleet, const std::vector<demo::DemoRobot>& robots,
                        const program::CommonOptions& network) {
  auto peer = fleet::JoinAsOperator(network, exchange::SenderTopics());
  if (!peer) return tl::unexpected(peer.error());
  demo::DemoDispatch dispatch(peer->self, robots);
  WatchOptions watch;
  watch.headline = [&](double elapsed_s) {
    const auto address = fleet.ConsoleAddress();
    return address ? fmt::format("{:.0f} s: open {} in a browser; Ctrl-C here ends everything",
                                 elapsed_s, *address)
                   : fmt::format("{:.0f} s: the console starts", elapsed_s);
  };
  watch.hear = [&](const std::vector<exchange::Message>& messages) {
    dispatch.Hear(messages);
    (void)exchange::PublishAll(*peer->exchange, dispatch.Due(Clock::now()));
  };
  switch (Watch(fleet, robots, *peer->exchange, std::move(watch)).Run()) {
    case Watched::kInterrupted:
      std::fputs("ending the robots\n", stderr);
      return program::kExitOk;
    case Watched::kEnded:
      std::fputs("all robots have ended\n", stderr);
      [[fallthrough]];
    default:
      return program::kExitFailure;
  }
}

Result<int> RunDemo(const program::CommonOptions& common, const DemoOptions& options) {
  if (!std::filesystem::is_directory(options.out)) {
    return Fail(ErrorCode::kInvalidArgument, "--out {} is no folder", options.out.string());
  }
  const program::StopSignal stop;
  const auto programs = ProgramFolder();
  if (!programs) return tl::unexpected(programs.error());
  auto folder = WorkFolder::Make();
  if (!folder) return tl::unexpected(folder.error());
  if (options.keep) {
    folder->Keep();
    fmt::print("logs, stores and true poses: {}\n", folder->path().string());
  }
  const auto robots = options.console ? demo::PlanDuty(folder->path(), options.seed)
                                      : demo::PlanRobots(folder->path(), options.seed);
  if (!robots) return tl::unexpected(robots.error());
  const program::CommonOptions network = PrivateNetwork(common);
  auto fleet = demo::DemoFleet::Start(*programs, folder->path(), *robots, network);
  if (!fleet) return tl::unexpected(fleet.error());
  // Whoever shows what agents say of themselves has to hear them; in a star they hear servers only.
  program::CommonOptions everybody = network;
  everybody.discovery = "mesh";
  if (!options.console) return ShowArrivals(*fleet, *robots, everybody, options);
  const auto console = fleet->StartConsole(*programs, folder->path(), everybody, options.http_port);
  if (!console) return tl::unexpected(console.error());
  return ShowConsole(*fleet, *robots, everybody);
}

}  // namespace

Command AddDemoCommand(CLI::App& parent, const program::CommonOptions& common) {
  auto options = std::make_shared<DemoOptions>();
  CLI::App* app = parent.add_subcommand(
      "demo", "Show a scout teaching a route to three robots with other cameras, over DDS");
  app->footer(kExamples);
  app->option_defaults()->always_capture_default();
  app->add_option("--seed", options->seed, "Draws the robots");
  app->add_option("--out", options->out, "Folder for the picture, trailcast-demo.png");
  app->add_flag("--keep", options->keep, "Keep the temporary folder: logs, stores, true poses");
  auto* timeout = app->add_option("--timeout", options->timeout_s, "Seconds after which to give up")
                      ->check(CLI::Range(1.0, 86400.0));
  auto* console = app->add_flag("--console", options->console,
                                "Robots on duty, and a console to send and stop them in a browser, "
                                "until Ctrl-C")
                      ->excludes(timeout);
  app->add_option("--http-port", options->http_port, "Port of the console; 0: any that is free")
      ->needs(console)
      ->check(CLI::Range(0, 65535));
  return {app, [app, options, &common] {
            const auto status = RunDemo(common, *options);
            return status ? *status : program::Complain(*app, status.error());
          }};
}

}  // namespace trailcast::tool
