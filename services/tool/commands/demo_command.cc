#include <unistd.h>

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <memory>
#include <random>
#include <string>
#include <system_error>
#include <vector>

#include "services/base/work_folder.h"
#include "services/exchange/publish.h"
#include "services/fleet/operator_peer.h"
#include "services/lab/demo/demo_dispatch.h"
#include "services/lab/demo/demo_fleet.h"
#include "services/lab/demo/demo_report.h"
#include "services/lab/demo/journey_report.h"
#include "services/lab/demo/network_show.h"
#include "services/lab/sim/places/indoor_world.h"
#include "services/lab/trial/trial_plot.h"
#include "services/program/open_exchange.h"
#include "services/program/stop_signal.h"
#include "services/tool/commands/command.h"
#include "services/tool/commands/demo_watch.h"

namespace trailcast::tool {
namespace {

using Clock = std::chrono::steady_clock;

struct DemoOptions {
  std::uint64_t seed = 1;
  std::filesystem::path out = ".";
  bool keep = false;
  bool moving = false;
  double timeout_s = 600.0;
  bool console = false;
  bool network = false;
  int http_port = 8080;
};

constexpr const char* kPicture = "trailcast-demo.png";
constexpr const char* kMovingPicture = "trailcast-demo.svg";
constexpr int kExitInterrupted = 130;
constexpr std::size_t kLogLines = 8;

constexpr const char* kDemoExamples =
    "Examples:\n"
    "  trailcast demo\n"
    "  trailcast demo --seed 7 --out /tmp\n"
    "  trailcast demo --moving          # and a picture in which they drive, trailcast-demo.svg\n"
    "  trailcast demo --keep            # leaves logs, stores and true poses to look at\n"
    "  trailcast demo --console         # available robots: sent, seen and stopped in a browser\n"
    "  trailcast demo --network         # three scouts' routes are joined, five robots sent over "
    "them\n"
    "Exit status: 0 all arrived (with --network: or one that was carried off said why not; with\n"
    "--console: ended by Ctrl-C), 3 some did not,\n"
    "130 interrupted, 1 failed, 2 wrong usage.";

// Returns a network that other demos and real robots on this machine do not see.
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

// Draws a picture of the paths, and a moving one if it is asked for.
Result<void> DrawPicture(const std::string& title, std::vector<plot::PlottedPath> paths,
                         const DemoOptions& options) {
  const auto world = sim::MakeIndoorWorld();
  if (!world) return tl::unexpected(world.error());
  plot::Plan plan;
  plan.title = title;
  plan.paths = std::move(paths);
  plan.backdrop = trial::WorldBackdrop(*world->world, plan.paths);
  const std::filesystem::path picture = options.out / kPicture;
  if (auto drawn = plot::DrawPlan(plan).Write(picture); !drawn) return drawn;
  fmt::print("The paths, seen from above: {}\n", picture.string());
  if (!options.moving) return {};
  const std::filesystem::path moving = options.out / kMovingPicture;
  if (auto drawn = plot::WriteMovingPlan(plan, {}, moving); !drawn) return drawn;
  fmt::print("The same as a picture that moves: {}\n", moving.string());
  return {};
}

// Prints a table and draws a picture, from the files that the processes left.
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
  const auto drawn = DrawPicture("trailcast demo: one scout teaches, three other cameras follow",
                                 demo::DemoPaths(rows), options);
  if (!drawn) return tl::unexpected(drawn.error());
  return all ? program::kExitOk : program::kExitNotArrived;
}

// Watches a demo until it ends by itself or is given up, and reports.
Result<int> WatchToTheEnd(demo::DemoFleet& fleet, const std::vector<demo::DemoRobot>& robots,
                          const program::CommonOptions& network, WatchOptions watch,
                          const std::function<Result<int>()>& report) {
  exchange::TopicUse use = exchange::ObserverTopics();
  use.read.push_back(exchange::Topic::kMissionStates);
  const auto exchange = program::OpenExchange(network, use);
  if (!exchange) return tl::unexpected(exchange.error());
  const double timeout_s = watch.timeout_s;
  switch (WatchFleet(fleet, robots, **exchange, std::move(watch))) {
    case Watched::kInterrupted:
      std::fputs("interrupted: ending the robots\n", stderr);
      return kExitInterrupted;
    case Watched::kBroken:
      return program::kExitFailure;
    case Watched::kTooLong:
      fmt::print(stderr, "still under way after {:.0f} s: giving up (--timeout)\n", timeout_s);
      [[fallthrough]];
    case Watched::kEnded:
      return report();
  }
  return program::kExitFailure;
}

// Shows robots until they have arrived, with a picture and a table.
Result<int> ShowArrivals(demo::DemoFleet& fleet, const std::vector<demo::DemoRobot>& robots,
                         const program::CommonOptions& network, const DemoOptions& options) {
  WatchOptions watch;
  watch.timeout_s = options.timeout_s;
  watch.headline = [](double elapsed_s) {
    return fmt::format("{:.0f} s: a scout teaches, three robots with other cameras follow",
                       elapsed_s);
  };
  return WatchToTheEnd(fleet, robots, network, std::move(watch),
                       [&] { return Report(fleet, robots, options); });
}

// Prints a table and draws a picture of robots that were sent over a network of routes.
Result<int> ReportJourneys(demo::DemoFleet& fleet, const demo::NetworkPlan& plan,
                           const demo::NetworkShow& show, const DemoOptions& options) {
  fleet.Stop();
  std::fputs("\nWhat the operator typed, and what was answered:\n", stdout);
  for (const std::string& line : show.typed()) fmt::print("  {}\n", line);
  const auto report = demo::JudgeJourneys(plan, show.Ends());
  if (!report) return tl::unexpected(report.error());
  std::fputs(("\n" + demo::JourneyTable(*report)).c_str(), stdout);
  const auto drawn = DrawPicture("trailcast demo: three routes joined, five other cameras sent",
                                 demo::JourneyPaths(plan, *report), options);
  if (!drawn) return tl::unexpected(drawn.error());
  return report->AllWell() ? program::kExitOk : program::kExitNotArrived;
}

// Shows three routes that are joined, and five robots that are sent over them.
Result<int> ShowNetwork(const std::filesystem::path& programs, const std::filesystem::path& folder,
                        const program::CommonOptions& network,
                        const program::CommonOptions& everybody, const DemoOptions& options) {
  const auto plan = demo::PlanNetwork(folder, options.seed);
  if (!plan) return tl::unexpected(plan.error());
  auto fleet = demo::DemoFleet::Start(programs, folder, plan->robots, network);
  if (!fleet) return tl::unexpected(fleet.error());
  demo::NetworkShow show(programs, folder, network, *plan);
  WatchOptions watch;
  watch.timeout_s = options.timeout_s;
  watch.headline = [&](double elapsed_s) {
    return fmt::format("{:.0f} s: {}", elapsed_s,
                       show.typed().empty() ? "three scouts teach" : show.typed().back());
  };
  watch.hear = [&](const std::vector<exchange::Message>& messages) { show.Hear(messages); };
  watch.step = [&](const demo::FleetView& view) -> Result<bool> {
    if (auto stepped = show.Step(view, Clock::now()); !stepped) {
      return tl::unexpected(stepped.error());
    }
    return show.over();
  };
  return WatchToTheEnd(*fleet, plan->robots, everybody, std::move(watch),
                       [&] { return ReportJourneys(*fleet, *plan, show, options); });
}

// Shows available robots and a console until it is interrupted. Some robots are sent at once, so
// that there is something to see.
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
  switch (WatchFleet(fleet, robots, *peer->exchange, std::move(watch))) {
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
  const program::CommonOptions network = PrivateNetwork(common);
  // The console has to hear the agents themselves, and in a star they hear only servers.
  program::CommonOptions everybody = network;
  everybody.discovery = "mesh";
  if (options.network) {
    return ShowNetwork(*programs, folder->path(), network, everybody, options);
  }
  const Result<std::vector<demo::DemoRobot>> robots =
      options.console ? demo::PlanDuty(folder->path(), options.seed)
                      : demo::PlanRobots(folder->path(), options.seed);
  if (!robots) return tl::unexpected(robots.error());
  auto fleet = demo::DemoFleet::Start(*programs, folder->path(), *robots, network);
  if (!fleet) return tl::unexpected(fleet.error());
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
  app->footer(kDemoExamples);
  app->option_defaults()->always_capture_default();
  app->add_option("--seed", options->seed, "Draws the robots");
  app->add_option("--out", options->out, "Folder for the picture, trailcast-demo.png");
  app->add_flag("--keep", options->keep, "Keep the temporary folder: logs, stores, true poses");
  auto* moving = app->add_flag("--moving", options->moving,
                               "Also a picture in which robots drive, trailcast-demo.svg");
  auto* timeout = app->add_option("--timeout", options->timeout_s, "Seconds after which to give up")
                      ->check(CLI::Range(1.0, 86400.0));
  auto* console =
      app->add_flag("--console", options->console,
                    "Available robots, and a console to send and stop them in a browser, "
                    "until Ctrl-C")
          ->excludes(timeout)
          ->excludes(moving);
  app->add_flag(
         "--network", options->network,
         "Three scouts teach, their routes are joined, and five robots with other cameras are "
         "sent to one place, while a part of the way is closed and one of them is carried off")
      ->excludes(console);
  app->add_option("--http-port", options->http_port, "Port of the console; 0: any that is free")
      ->needs(console)
      ->check(CLI::Range(0, 65535));
  return {app, [app, options, &common] {
            const auto status = RunDemo(common, *options);
            return status ? *status : program::Complain(*app, status.error());
          }};
}

}  // namespace trailcast::tool
