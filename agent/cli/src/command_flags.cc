// This file has the flags of the program and of its commands.
#include <fmt/format.h>

#include <filesystem>

#include "agent/cli/src/commands.h"
#include "agent/duty/refreshing.h"
#include "services/program/place_options.h"

namespace trailcast::agent {
namespace {

// The longest time that can be given is a week.
constexpr double kLongest_s = 7.0 * 24.0 * 3600.0;

constexpr const char* kHowItFollows = "How it follows";

CLI::Validator IsMcapName() {
  return {[](std::string& file) -> std::string {
            if (std::filesystem::path(file).extension() == ".mcap") return "";
            return fmt::format("'{}': a log is an MCAP file: expected a name that ends in .mcap",
                               file);
          },
          "FILE.mcap"};
}

void AddRoute(CLI::App& command, std::string& route) {
  command
      .add_option("--route", route,
                  "The route's name; of one that is in the store already its id, or 7 digits or "
                  "more of it, will do")
      ->required()
      ->check(program::NameValidator());
}

void AddRouteRef(CLI::App& command, std::string& route) {
  command
      .add_option("--route", route,
                  "The route's name, or its id, of which 7 digits or more will do; '@2' behind it "
                  "is its revision 2")
      ->required()
      ->check(program::RouteRefValidator());
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
                  "Seconds to wait at the end for a server's acknowledgements")
      ->check(CLI::Range(0.0, kLongest_s));
}

void AddTerrainOptions(CLI::App& command, ReplayCommand& replay) {
  const std::string group = "The ground, as it was felt when the route was taught";
  command
      .add_option("--max-slope", replay.max_slope_deg,
                  "Degrees, up or down, that the robot can drive: it refuses a route with more")
      ->check(CLI::Range(0.0, 90.0))
      ->group(group);
  std::vector<std::string> names;
  for (const route::RoughnessClass& each : route::RoughnessClasses()) names.emplace_back(each.name);
  command
      .add_option("--max-roughness", replay.max_roughness,
                  "How rough the ground may be that the robot can drive: it refuses a route with "
                  "more")
      ->check(CLI::IsMember(names))
      ->group(group);
  command
      .add_flag("--comfort", replay.comfort,
                "Slower than it was taught where the ground is rough, from before it begins")
      ->group(group);
}

// These flags tell how any route is followed.
void AddFollowing(CLI::App& command, ReplayCommand& replay, DeviceUse use) {
  command.option_defaults()->group(kHowItFollows);
  command
      .add_option("--method", replay.method,
                  "The project's best, the 2009 method as printed, or its first version of 2006")
      ->check(CLI::IsMember(ReplayMethodNames()));
  command
      .add_option("--wait", replay.wait_s,
                  "Seconds to wait for a server, the route or the next segment while none comes")
      ->check(CLI::Range(0.0, kLongest_s));
  command
      .add_option(
          "--keep-distance", replay.keep_distance_m,
          "With --server: metres along the path to keep from followers ahead; 0: keeps none")
      ->check(CLI::Range(0.0, 1000.0));
  command
      .add_option("--look-around", replay.look_around_deg,
                  "Degrees to either side by which a robot that has lost its path from view, and "
                  "would give up, turns on the spot to find it again, by odometry and the default "
                  "method; cars and recordings do not. 0: it stands")
      ->check(CLI::Range(0.0, 180.0));
  command
      .add_option("--refresh", replay.refresh,
                  "What becomes of a route that has changed since it was taught, once the robot "
                  "has arrived on it by the default method: nothing (off); a revision of it with "
                  "what is seen today in place of what is long gone, without odometry only beside "
                  "what was seen, which robots follow once an operator has looked at it and "
                  "activates it (review); the same, which needs no look (auto)")
      ->check(CLI::IsMember(RefreshingNames()))
      ->capture_default_str();
  command.option_defaults()->group(program::kFirstGroup);
  AddDeviceOptions(command, replay.device, use);
  AddTerrainOptions(command, replay);
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
  command.add_flag("--review", teach.review,
                   "No robot follows it before an operator has looked at it and activates it: "
                   "'trailcast routes activate'; until then they go on with what they follow now");
  command
      .add_option("--unfinished", teach.unfinished,
                  "What becomes of the last teaching of this route if it was cut off: taught on "
                  "from where it ended, by a drive over its last metres once more (go-on); kept as "
                  "it is (keep); dropped (discard); or as the terminal answers, without one: keep "
                  "(ask)")
      ->check(CLI::IsMember(UnfinishedNames()))
      ->capture_default_str();
  AddDeliveryTimeout(command, teach);
  AddDeviceOptions(command, teach.device, DeviceUse::kTeach);
}

void AddReplayOptions(CLI::App& command, ReplayCommand& replay) {
  AddRouteRef(command, replay.route);
  AddRevision(command, replay.revision, "Default: the active one");
  AddScout(command, replay.scout);
  command
      .add_option("--log", replay.diagnosis.log,
                  "Writes what the robot saw and why it did what it did here, while it runs, for "
                  "'trailcast explain FILE.mcap' and for viewers of MCAP files")
      ->check(IsMcapName());
  command.add_flag("--wait-for-route", replay.wait_for_route,
                   "With --server: also wait for a route that no server knows yet");
  command
      .add_option("--start", replay.start,
                  "Where the robot is at first: where its last run has left it, or else at the "
                  "route's beginning, or else anywhere on the route (left); at the beginning; "
                  "anywhere: it stands until it knows where")
      ->check(CLI::IsMember({"left", "beginning", "anywhere"}))
      ->capture_default_str();
  command.option_defaults()->group("What it writes");
  command.add_option("--csv", replay.csv, "Writes one row a frame here");
  CLI::Option* view =
      command.add_option("--view", replay.diagnosis.view,
                         "Draws what the robot saw: one picture a frame into this folder");
  command
      .add_option("--view-every", replay.diagnosis.view_every, "Only every so many frames of them")
      ->check(CLI::Range(1, 1'000'000))
      ->needs(view);
  command.option_defaults()->group(kHowItFollows);
  command.add_flag("--from-start", replay.from_start,
                   "With --start left: forgets where its last run has left it");
  command.add_option("--speed-factor", replay.speed_factor, "Times the taught speed")
      ->check(CLI::Range(0.1, 3.0));
  command.add_flag("--backwards", replay.backwards,
                   "In reverse gear along what was taught forwards, from the route's end to its "
                   "beginning (which change places in --start), at half the taught speed, the "
                   "camera looking as it did; by odometry and the default method. What is behind "
                   "the robot it does not see");
  command.option_defaults()->group(program::kFirstGroup);
  AddFollowing(command, replay, DeviceUse::kReplay);
}

void AddServeOptions(CLI::App& command, ServeCommand& serve) {
  command
      .add_option("--logs", serve.logs.folder,
                  "Folder for a log of each route that it follows, MISSION-TASK-LAP.mcap, for "
                  "'trailcast explain' and the console's history; made if missing")
      ->check(!CLI::ExistingFile);
  CLI::Option* logs = command.get_option("--logs");
  command
      .add_option("--logs-mb", serve.logs_mb,
                  "Megabytes that the logs may have: the oldest make room; one of them has a "
                  "quarter at most")
      ->check(CLI::Range(1.0, 1e6))
      ->capture_default_str()
      ->needs(logs);
  command
      .add_option("--logs-pictures", serve.logs.picture_every_s,
                  "Seconds from picture to picture in them; 0: no pictures, and not where "
                  "features are")
      ->check(CLI::Range(0.0, 3600.0))
      ->capture_default_str()
      ->needs(logs);
  command
      .add_option("--photos", serve.photos,
                  "Folder for the photos that its missions ask for, until a server has them; made "
                  "if missing; default: beside the store")
      ->check(!CLI::ExistingFile);
  command
      .add_option("--photos-mb", serve.photos_mb,
                  "Megabytes that the photos may have: the oldest make room")
      ->check(CLI::Range(1.0, 1e6))
      ->capture_default_str();
  AddFollowing(command, serve.replay, DeviceUse::kOnDuty);
  SimulatedRun& simulated = serve.replay.device.simulated;
  command
      .add_flag(
          "--sim-driver", simulated.has_driver,
          "Whoever is to drive the simulated robot when it teaches is simulated, too, and drives "
          "it along the path")
      ->needs("--sim")
      ->group("Simulated robot");
}

void AddFetchOptions(CLI::App& command, FetchCommand& fetch) {
  AddRouteRef(command, fetch.route);
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

}  // namespace trailcast::agent
