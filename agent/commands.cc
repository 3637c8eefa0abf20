#include "agent/commands.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <cstdio>
#include <filesystem>
#include <utility>
#include <vector>

#include "agent/fetch.h"
#include "services/base/time.h"
#include "services/program/open_exchange.h"
#include "services/program/output_file.h"
#include "services/program/place_options.h"
#include "services/program/stop_signal.h"

namespace trailcast::agent {
namespace {

// Longest time that can be asked for: a week.
constexpr double kLongest_s = 7.0 * 24.0 * 3600.0;

void AddRoute(CLI::App& command, std::string& route) {
  command.add_option("--route", route, "The route's name")
      ->required()
      ->check(program::NameValidator());
}

void AddScout(CLI::App& command, std::string& scout) {
  command.add_option("--scout", scout, "Of several routes of this name that of this scout")
      ->check(program::NameValidator());
}

void AddRevision(CLI::App& command, std::uint32_t& revision, const char* help) {
  command.add_option("--revision", revision, help)->check(program::RevisionValidator());
}

void AddDeliveryTimeout(CLI::App& command, TeachCommand& teach) {
  command
      .add_option("--delivery-timeout", teach.delivery_timeout_s,
                  "Seconds to wait at the end for a server's receipts")
      ->check(CLI::Range(0.0, kLongest_s));
}

Result<std::unique_ptr<exchange::RouteExchange>> Join(const CommandOptions& options,
                                                      const exchange::TopicUse& use) {
  if (!options.server) return nullptr;
  return program::OpenExchange(options.common, program::WithAgents(use));
}

// With keys only scouts may say what routes there are.
exchange::TopicUse FollowersTopics(const CommandOptions& options) {
  exchange::TopicUse use = exchange::FollowerTopics();
  if (options.common.security.empty()) use.write_rarely.push_back(exchange::Topic::kRoutes);
  return use;
}

ScoutLinkOptions LinkOptions(const CommandOptions& options, const TeachCommand& teach) {
  ScoutLinkOptions link;
  link.agent = AgentId(options.common.name);
  link.store_file = options.store_file;
  link.delivery_timeout = ToMilliseconds(teach.delivery_timeout_s);
  link.stop = [] { return program::StopSignal::requested(); };
  return link;
}

// Asked before the drive, so that what is to tell of it is not lost after.
Result<void> CanAllBeWritten(const std::vector<std::filesystem::path>& files) {
  for (const std::filesystem::path& file : files) {
    if (auto can = program::CanBeWritten(file); !can) return can;
  }
  return {};
}

Result<void> Tell(const Summary& summary, const CommandOptions& options) {
  fmt::print("{}", summary.Text());
  std::fflush(stdout);
  if (options.report.empty()) return {};
  return summary.Write(options.report);
}

Result<int> Ended(const Result<Summary>& summary, const CommandOptions& options) {
  if (!summary) return tl::unexpected(summary.error());
  if (auto told = Tell(*summary, options); !told) return tl::unexpected(told.error());
  return program::kExitOk;
}

FollowerOptions MakeFollowerOptions(const CommandOptions& options, const ReplayCommand& replay) {
  FollowerOptions follower;
  follower.link.agent = AgentId(options.common.name);
  follower.link.route = replay.route;
  follower.link.revision.number = replay.revision;
  follower.link.revision.scout = replay.scout;
  follower.link.store_file = options.store_file;
  follower.link.wait_for_route = replay.wait_for_route;
  follower.link.wait = ToMilliseconds(replay.wait_s);
  follower.link.stop = [] { return program::StopSignal::requested(); };
  if (const auto method = FindReplayMethod(replay.method)) follower.session.method = *method;
  follower.session.speed_factor = replay.speed_factor;
  follower.diagnosis = replay.diagnosis;
  follower.open_loop = replay.device.is_recorded();
  follower.session.anywhere = replay.start == "anywhere";
  follower.link.from_start = replay.from_start || replay.start != "left";
  // A robot of its own: one that is simulated here begins at the start whenever its agent does.
  if (!follower.open_loop && !replay.device.is_simulated()) {
    follower.link.place_file = options.store_file + "." + options.common.name + ".place";
  }
  // A recording drives on, whatever it is told.
  follower.keep_distance.distance_m = follower.open_loop ? 0.0 : replay.keep_distance_m;
  return follower;
}

}  // namespace

void AddSharedOptions(CLI::App& app, CommandOptions& options) {
  program::AddCommonOptions(app, options.common);
  app.add_option("--store", options.store_file,
                 "This agent's routes: a SQLite file, created if missing")
      ->required()
      ->envname("TRAILCAST_STORE");
  app.add_flag("--server", options.server,
               "Join the network: send segments to a route server while teaching, or fetch the "
               "route from there")
      ->envname("TRAILCAST_SERVER");
  app.add_option("--report", options.report, "Writes the summary here too, as key=value lines");
}

void AddTeachOptions(CLI::App& command, TeachCommand& teach) {
  AddRoute(command, teach.route);
  command
      .add_option("--tag", teach.tags,
                  "A word by which the route is found in the catalog; may be given several times")
      ->check(program::NameValidator())
      ->expected(1, static_cast<int>(route::kMaxTags))
      ->take_all()
      ->allow_extra_args(false);
  program::AddPlaceOptions(command, "place", "Where the route begins, for the catalog",
                           teach.place);
  AddDeliveryTimeout(command, teach);
  AddDeviceOptions(command, teach.device, true);
}

void AddReplayOptions(CLI::App& command, ReplayCommand& replay) {
  AddRoute(command, replay.route);
  AddRevision(command, replay.revision, "Default: the active one");
  AddScout(command, replay.scout);
  command.add_option("--csv", replay.csv, "Writes one row a frame here");
  command.add_option("--log", replay.diagnosis.log,
                     "Writes what the robot saw and why it did what it did here, while it runs; "
                     "'trailcast explain FILE' tells its story");
  CLI::Option* view =
      command.add_option("--view", replay.diagnosis.view,
                         "Draws what the robot saw: one picture a frame into this folder");
  command
      .add_option("--view-every", replay.diagnosis.view_every, "Only every so many frames of them")
      ->check(CLI::Range(1, 1'000'000))
      ->needs(view);
  command
      .add_option("--method", replay.method,
                  "The project's best, the 2009 method as printed, or its first version of 2006")
      ->check(CLI::IsMember(ReplayMethodNames()));
  command
      .add_option("--wait", replay.wait_s,
                  "Seconds to wait for a server, the route or the next segment while none comes")
      ->check(CLI::Range(0.0, kLongest_s));
  command.add_flag("--wait-for-route", replay.wait_for_route,
                   "With --server: also wait for a route that no server knows yet");
  command.add_option("--speed-factor", replay.speed_factor, "Times the taught speed")
      ->check(CLI::Range(0.1, 3.0));
  command
      .add_option("--start", replay.start,
                  "Where the robot is at first: where its last run has left it, or else at the "
                  "route's beginning (left); at the beginning; anywhere on the route: it stands "
                  "until it knows where")
      ->check(CLI::IsMember({"left", "beginning", "anywhere"}))
      ->capture_default_str();
  command.add_flag("--from-start", replay.from_start, "The same as --start beginning");
  command
      .add_option(
          "--keep-distance", replay.keep_distance_m,
          "With --server: metres along the path to keep from followers ahead; 0: keeps none")
      ->check(CLI::Range(0.0, 1000.0));
  AddDeviceOptions(command, replay.device, false);
}

void AddFetchOptions(CLI::App& command, FetchCommand& fetch) {
  AddRoute(command, fetch.route);
  AddRevision(command, fetch.revision, "Default: the newest that is complete");
  AddScout(command, fetch.scout);
  command
      .add_option("--wait", fetch.wait_s,
                  "Seconds to wait for a server, the route or the next segment while none comes")
      ->check(CLI::Range(0.0, kLongest_s));
}

void AddDeliverOptions(CLI::App& command, TeachCommand& deliver) {
  AddDeliveryTimeout(command, deliver);
}

Result<int> RunTeach(const CommandOptions& options, const TeachCommand& teach) {
  if (auto can = CanAllBeWritten({options.report, teach.device.truth}); !can) {
    return tl::unexpected(can.error());
  }
  auto opened = OpenDevice(teach.device, options.common);
  if (!opened) return tl::unexpected(opened.error());
  auto store = store::OpenSqliteStore(options.store_file);
  if (!store) return tl::unexpected(store.error());
  auto exchange = Join(options, exchange::ScoutTopics());
  if (!exchange) return tl::unexpected(exchange.error());
  const ScoutOptions scout{teach.route, LinkOptions(options, teach), teach.tags, teach.place};
  const auto summary = Teach(*opened->device, scout, std::move(*store), std::move(*exchange));
  if (auto truth = opened->WriteTruth(teach.device); !truth) return tl::unexpected(truth.error());
  return Ended(summary, options);
}

Result<int> RunDeliver(const CommandOptions& options, const TeachCommand& deliver) {
  if (auto can = program::CanBeWritten(options.report); !can) return tl::unexpected(can.error());
  auto store = store::OpenSqliteStore(options.store_file);
  if (!store) return tl::unexpected(store.error());
  auto exchange =
      program::OpenExchange(options.common, program::WithAgents(exchange::ScoutTopics()));
  if (!exchange) return tl::unexpected(exchange.error());
  return Ended(
      DeliverBacklog(LinkOptions(options, deliver), std::move(*store), std::move(*exchange)),
      options);
}

Result<int> RunFetch(const CommandOptions& options, const FetchCommand& fetch) {
  if (auto can = program::CanBeWritten(options.report); !can) return tl::unexpected(can.error());
  auto store = store::OpenSqliteStore(options.store_file);
  if (!store) return tl::unexpected(store.error());
  auto exchange =
      program::OpenExchange(options.common, program::WithAgents(FollowersTopics(options)));
  if (!exchange) return tl::unexpected(exchange.error());
  FollowerLinkOptions link;
  link.agent = AgentId(options.common.name);
  link.route = fetch.route;
  link.revision = {.number = fetch.revision, .newest = true, .scout = fetch.scout};
  link.store_file = options.store_file;
  link.wait = ToMilliseconds(fetch.wait_s);
  link.stop = [] { return program::StopSignal::requested(); };
  return Ended(Fetch(link, std::move(*store), std::move(*exchange)), options);
}

Result<int> RunReplay(const CommandOptions& options, const ReplayCommand& replay) {
  if (auto can =
          CanAllBeWritten({options.report, replay.csv, replay.diagnosis.log, replay.device.truth});
      !can) {
    return tl::unexpected(can.error());
  }
  auto opened = OpenDevice(replay.device, options.common);
  if (!opened) return tl::unexpected(opened.error());
  auto store = store::OpenSqliteStore(options.store_file);
  if (!store) return tl::unexpected(store.error());
  auto exchange = Join(options, FollowersTopics(options));
  if (!exchange) return tl::unexpected(exchange.error());
  const auto outcome = Replay(*opened->device, MakeFollowerOptions(options, replay),
                              std::move(*store), std::move(*exchange));
  if (!outcome) return tl::unexpected(outcome.error());
  auto written = Tell(outcome->summary, options);
  if (!replay.csv.empty() && written) written = outcome->log.WriteCsv(replay.csv);
  if (written) written = opened->WriteTruth(replay.device);
  if (written) written = outcome->diagnosed;
  if (outcome->error) return tl::unexpected(*outcome->error);
  if (!written) return tl::unexpected(written.error());
  if (outcome->success) return program::kExitOk;
  spdlog::warn("not arrived: {} ({})", outcome->state, outcome->reason);
  return program::kExitNotArrived;
}

}  // namespace trailcast::agent
