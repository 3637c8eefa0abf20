#include "agent/cli/src/commands.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <cstdio>
#include <filesystem>
#include <utility>
#include <vector>

#include "agent/camera_view/snapshots.h"
#include "agent/duty/on_duty.h"
#include "agent/duty/refreshing.h"
#include "agent/fetch/fetch.h"
#include "agent/teach/teachings.h"
#include "services/base/angles.h"
#include "services/base/time.h"
#include "services/photos/photo_folder.h"
#include "services/program/open_exchange.h"
#include "services/program/output_file.h"
#include "services/program/radio.h"
#include "services/program/stop_signal.h"

namespace trailcast::agent {
namespace {

// A follower's process writes only copies; routes taught into the same file are on the disk
// already.
constexpr store::SqliteOptions kOfCopies{.durability =
                                             store::SqliteOptions::Durability::kWithRoutes};

// A robot that takes missions has more to do than to wait for a server.
constexpr double kDeliverOnDuty_s = 10.0;

Result<std::unique_ptr<exchange::RouteExchange>> Join(const CommandOptions& options,
                                                      const exchange::TopicUse& use) {
  if (!options.server) return nullptr;
  return program::OpenExchange(options.common, program::WithAgents(use));
}

// The device outlives the callers.
std::function<program::Vitals()> VitalsOf(const RobotDevice& device,
                                          const CommandOptions& options) {
  return [&device, radio = options.common.network_interface] {
    return program::Vitals{device.battery_percent(), program::LinkPercent(radio)};
  };
}

// With keys, only scouts may announce routes.
exchange::TopicUse FollowersTopics(const CommandOptions& options,
                                   exchange::TopicUse use = exchange::FollowerTopics()) {
  if (options.common.security.empty()) use.write_rarely.push_back(exchange::Topic::kRoutes);
  return use;
}

// A robot that takes missions mostly follows. It rarely writes what a scout does, and only
// overhears requests for segments, which are repeated.
exchange::TopicUse TeachingToo(exchange::TopicUse use) {
  const exchange::TopicUse teaching = exchange::TeachingTopics();
  for (const exchange::Topic topic : teaching.write) {
    if (!use.Writes(topic)) use.write_rarely.push_back(topic);
  }
  for (const exchange::Topic topic : teaching.read) {
    if (!use.Hears(topic)) use.read.push_back(topic);
  }
  return use;
}

// Adds the topics of a robot whose camera others look through: it hears their requests and answers
// them.
exchange::TopicUse WithSnapshots(exchange::TopicUse use) {
  const exchange::TopicUse theirs = exchange::SnapshotTopics();
  use.read.insert(use.read.end(), theirs.write.begin(), theirs.write.end());
  use.write_rarely.insert(use.write_rarely.end(), theirs.read.begin(), theirs.read.end());
  return use;
}

ScoutLinkOptions LinkOptions(const CommandOptions& options, double delivery_timeout_s) {
  ScoutLinkOptions link;
  link.agent = AgentId(options.common.name);
  link.store_file = options.store_file;
  link.delivery_timeout = ToMilliseconds(delivery_timeout_s);
  link.stop = [] { return program::StopSignal::requested(); };
  return link;
}

// This is checked before the drive, so that no report on it is lost afterwards.
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

std::string BesideStore(const CommandOptions& options, const char* what) {
  return fmt::format("{}.{}.{}", options.store_file, options.common.name, what);
}

FollowerOptions MakeFollowerOptions(const CommandOptions& options, const ReplayCommand& replay,
                                    const route::RouteRef& ref) {
  FollowerOptions follower;
  follower.link.agent = AgentId(options.common.name);
  follower.link.route = ref.route;
  follower.link.revision.number = ref.revision;
  follower.link.revision.scout = replay.scout;
  follower.link.store_file = options.store_file;
  follower.link.wait_for_route = replay.wait_for_route;
  follower.link.wait = ToMilliseconds(replay.wait_s);
  follower.link.stop = [] { return program::StopSignal::requested(); };
  if (const auto method = FindReplayMethod(replay.method)) follower.how.session.method = *method;
  follower.how.session.speed_factor = replay.speed_factor;
  follower.how.session.intake = replay.device.intake;
  follower.how.session.camera_ahead_m = replay.device.camera_ahead_m;
  follower.how.session.passing.most_m = replay.device.pass_obstacles_m;
  follower.how.session.passing.robot = OutlineOf(replay.device.ros2.obstacles);
  const bool turns_on_the_spot =
      !replay.device.is_recorded() && replay.device.ros2.limits.turn_radius_m == 0.0;
  follower.how.session.look_around_rad = turns_on_the_spot ? Radians(replay.look_around_deg) : 0.0;
  follower.how.backwards = replay.backwards;
  follower.how.session.take_experience = RefreshingOf(replay.refresh) != Refreshing::kOff;
  follower.diagnosis = replay.diagnosis;
  follower.open_loop = replay.device.is_recorded();
  follower.diagnosis.patient = follower.open_loop;
  follower.how.session.anywhere = replay.start == "anywhere";
  follower.how.session.else_anywhere = replay.start == "left" && !follower.open_loop;
  follower.link.from_start = replay.from_start || replay.start != "left";
  // A simulated robot of this process begins at the start whenever its agent does, so its place is
  // not kept.
  if (!follower.open_loop && !replay.device.is_simulated()) {
    follower.link.place_file = BesideStore(options, "place");
  }
  // A recording drives on, whatever the commands are.
  follower.link.hears_operators = !follower.open_loop;
  if (!follower.open_loop) follower.link.stop_file = BesideStore(options, "stop");
  follower.keep_distance.distance_m = follower.open_loop ? 0.0 : replay.keep_distance_m;
  if (replay.max_slope_deg) follower.how.terrain.slope_rad = Radians(*replay.max_slope_deg);
  follower.how.terrain.roughness = route::FindRoughness(replay.max_roughness);
  follower.how.comfort = replay.comfort;
  return follower;
}

OnDutyOptions MakeOnDutyOptions(const CommandOptions& options, const ServeCommand& serve) {
  OnDutyOptions duty;
  duty.agent = AgentId(options.common.name);
  duty.missions_file = BesideStore(options, "missions");
  duty.stop_file = BesideStore(options, "stop");
  duty.logs = serve.logs;
  duty.logs.most_bytes = static_cast<std::uint64_t>(1e6 * serve.logs_mb);
  duty.follower = [&](const mission::Task& task) {
    ReplayCommand replay = serve.replay;
    replay.speed_factor = task.speed_factor;
    return MakeFollowerOptions(options, replay, task.route);
  };
  duty.scout = [&](const mission::Task& /*task*/) {
    ScoutOptions scout;
    scout.link = LinkOptions(options, kDeliverOnDuty_s);
    scout.intake = serve.replay.device.intake;
    return scout;
  };
  duty.refreshing = RefreshingOf(serve.replay.refresh);
  duty.open_scouts_store = [&] { return store::OpenSqliteStore(options.store_file); };
  duty.open_store = [&] { return store::OpenSqliteStore(options.store_file, kOfCopies); };
  duty.stop = [] { return program::StopSignal::requested(); };
  return duty;
}

// This follows a run that has arrived, so its failure is not the run's.
void RefreshRoute(const CommandOptions& options, const ReplayCommand& replay,
                  const ReplayOutcome& outcome) {
  const Refreshing how = RefreshingOf(replay.refresh);
  if (how == Refreshing::kOff || !outcome.visit) return;
  auto store = store::OpenSqliteStore(options.store_file);
  if (!store) return spdlog::warn("the route is not refreshed: {}", store.error().message);
  const AgentId self(options.common.name);
  const auto refreshed = StoreRefreshed(self, *outcome.followed, *outcome.visit, how, **store);
  TellRefreshed(refreshed);
  if (!refreshed || !options.server) return;
  if (!program::KeysAllow(options.common, exchange::TeachingTopics())) {
    return spdlog::warn("with a follower's keys it cannot be sent: it is in {}",
                        options.store_file);
  }
  auto exchange =
      program::OpenExchange(options.common, program::WithAgents(exchange::ScoutTopics()));
  if (!exchange) return spdlog::warn("it is not sent: {}", exchange.error().message);
  const auto sent =
      DeliverBacklog(LinkOptions(options, replay.wait_s), std::move(*store), std::move(*exchange));
  if (!sent) spdlog::warn("{}", sent.error().message);
}

}  // namespace

Result<int> RunServe(const CommandOptions& options, const ServeCommand& serve) {
  DeviceOptions robot = serve.replay.device;
  robot.simulated.in_real_time = true;  // so that people can watch and pause it
  auto opened = OpenDevice(robot, options.common);
  if (!opened) return tl::unexpected(opened.error());
  OnDutyOptions duty = MakeOnDutyOptions(options, serve);
  exchange::TopicUse use = FollowersTopics(options, exchange::OnDutyTopics());
  if (program::KeysAllow(options.common, exchange::TeachingTopics())) {
    use = TeachingToo(std::move(use));
  } else {
    duty.why_no_scout = "this robot has a follower's keys: only one with a scout's teaches";
  }
  auto exchange = program::OpenExchange(options.common, program::WithAgents(std::move(use)));
  if (!exchange) return tl::unexpected(exchange.error());
  duty.vitals = VitalsOf(*opened->device, options);
  const auto photo_folder = photos::PhotoFolder::Open(
      serve.photos.empty() ? BesideStore(options, "photos") : serve.photos,
      static_cast<std::uint64_t>(1e6 * serve.photos_mb));
  if (photo_folder) {
    duty.photo_folder = photo_folder->get();
  } else {
    spdlog::error("{}", photo_folder.error().message);
  }
  if (auto served = ServeOnDuty(*opened->device, duty, std::move(*exchange)); !served) {
    return tl::unexpected(served.error());
  }
  return program::kExitOk;
}

Result<int> RunTeach(const CommandOptions& options, const TeachCommand& teach) {
  if (auto can = CanAllBeWritten({options.report, teach.device.simulated.truth}); !can) {
    return tl::unexpected(can.error());
  }
  auto opened = OpenDevice(teach.device, options.common);
  if (!opened) return tl::unexpected(opened.error());
  auto store = store::OpenSqliteStore(options.store_file);
  if (!store) return tl::unexpected(store.error());
  auto exchange = Join(options, WithSnapshots(exchange::ScoutTopics()));
  if (!exchange) return tl::unexpected(exchange.error());
  Snapshots snapshots(AgentId(options.common.name));
  ScoutOptions scout{teach.route,         LinkOptions(options, teach.delivery_timeout_s),
                     teach.tags,          teach.place,
                     teach.review,        UnfinishedOf(teach.unfinished),
                     teach.device.intake, &snapshots};
  scout.link.vitals = VitalsOf(*opened->device, options);
  const auto summary =
      Teach(*opened->device, scout, std::move(*store), snapshots.Through(std::move(*exchange)));
  if (auto truth = opened->TruthWritten(); !truth) return tl::unexpected(truth.error());
  return Ended(summary, options);
}

Result<int> RunDeliver(const CommandOptions& options, const TeachCommand& deliver) {
  if (auto can = program::CanBeWritten(options.report); !can) return tl::unexpected(can.error());
  auto store = store::OpenExistingSqliteStore(options.store_file);
  if (!store) return tl::unexpected(store.error());
  auto exchange =
      program::OpenExchange(options.common, program::WithAgents(exchange::ScoutTopics()));
  if (!exchange) return tl::unexpected(exchange.error());
  return Ended(DeliverBacklog(LinkOptions(options, deliver.delivery_timeout_s), std::move(*store),
                              std::move(*exchange)),
               options);
}

Result<int> RunTeachings(const CommandOptions& options) {
  auto store = store::OpenExistingSqliteStore(options.store_file);
  if (!store) return tl::unexpected(store.error());
  const auto text = TeachingsText(**store, options.store_file);
  if (!text) return tl::unexpected(text.error());
  fmt::print("{}", *text);
  return program::kExitOk;
}

Result<int> RunFetch(const CommandOptions& options, const FetchCommand& fetch) {
  const auto ref = program::WithRevision(fetch.route, fetch.revision);
  if (!ref) return tl::unexpected(ref.error());
  if (auto can = program::CanBeWritten(options.report); !can) return tl::unexpected(can.error());
  auto store = store::OpenSqliteStore(options.store_file, kOfCopies);
  if (!store) return tl::unexpected(store.error());
  auto exchange =
      program::OpenExchange(options.common, program::WithAgents(FollowersTopics(options)));
  if (!exchange) return tl::unexpected(exchange.error());
  FollowerLinkOptions link;
  link.agent = AgentId(options.common.name);
  link.route = ref->route;
  link.revision = {.number = ref->revision, .newest = true, .scout = fetch.scout};
  link.store_file = options.store_file;
  link.wait = ToMilliseconds(fetch.wait_s);
  link.stop = [] { return program::StopSignal::requested(); };
  return Ended(Fetch(link, std::move(*store), std::move(*exchange)), options);
}

Result<int> RunReplay(const CommandOptions& options, const ReplayCommand& replay) {
  const auto ref = program::WithRevision(replay.route, replay.revision);
  if (!ref) return tl::unexpected(ref.error());
  if (auto can = CanAllBeWritten(
          {options.report, replay.csv, replay.diagnosis.log, replay.device.simulated.truth});
      !can) {
    return tl::unexpected(can.error());
  }
  auto opened = OpenDevice(replay.device, options.common);
  if (!opened) return tl::unexpected(opened.error());
  auto store = store::OpenSqliteStore(options.store_file, kOfCopies);
  if (!store) return tl::unexpected(store.error());
  auto exchange = Join(options, WithSnapshots(FollowersTopics(options, exchange::ReplayTopics())));
  if (!exchange) return tl::unexpected(exchange.error());
  Snapshots snapshots(AgentId(options.common.name));
  FollowerOptions follower = MakeFollowerOptions(options, replay, *ref);
  follower.snapshots = &snapshots;
  follower.link.vitals = VitalsOf(*opened->device, options);
  const auto outcome =
      Replay(*opened->device, follower, std::move(*store), snapshots.Through(std::move(*exchange)));
  if (!outcome) return tl::unexpected(outcome.error());
  auto written = Tell(outcome->summary, options);
  if (!replay.csv.empty() && written) written = outcome->log.WriteCsv(replay.csv);
  if (written) written = opened->TruthWritten();
  if (written) written = outcome->diagnosed;
  if (outcome->error) return tl::unexpected(*outcome->error);
  if (!written) return tl::unexpected(written.error());
  RefreshRoute(options, replay, *outcome);
  if (outcome->success) return program::kExitOk;
  spdlog::warn("not arrived: {} ({})", outcome->state, outcome->reason);
  return program::kExitNotArrived;
}

}  // namespace trailcast::agent
