#include "agent/cli/src/commands.h"
#include "services/program/heap.h"
#include "services/program/heartbeat.h"
#include "services/program/stop_signal.h"

namespace {

namespace program = trailcast::program;
namespace agent = trailcast::agent;

constexpr const char* kFooter = R"(Examples:
  trailcast-agent teach  --frames drive1/ --odometry drive1.csv --route hall --store scout.db
  trailcast-agent replay --frames drive2/ --route hall --store scout.db --log run.mcap
                         # then: trailcast explain run.mcap
  trailcast-agent teach  --sim shop.obj --path path.csv --route shop --store scout.db --server
  trailcast-agent replay --sim shop.obj --path path.csv --camera wide --seed 7 --name robot2
                         --route shop --store robot2.db --server --wait-for-route
  trailcast-agent serve  --ros2 /robot2 --name robot2 --store robot2.db
                         # waits for 'trailcast send robot2 follow shop'
  trailcast-agent fetch  --route shop --store robot2.db   # to hold it before it is activated
  trailcast-agent deliver --store scout.db
  trailcast-agent teachings --store scout.db              # what is there, and what was cut off

Exit status: 0 taught and delivered, arrived, or recording replayed to its end; 3 the follower did
not arrive; 2 wrong usage; 1 anything else. 'trailcast-agent COMMAND --help' tells more.)";

int Run(int argc, char** argv) {
  CLI::App app("A robot's agent: teaches a route, or follows one that was taught.",
               "trailcast-agent");
  app.footer(kFooter);
  agent::CommandOptions options;
  agent::AddSharedOptions(app, options);
  app.require_subcommand(1);
  app.fallthrough();
  agent::TeachCommand teach;
  agent::ReplayCommand replay;
  agent::ServeCommand serve;
  agent::FetchCommand fetch;
  agent::TeachCommand deliver;
  CLI::App* teach_app = app.add_subcommand("teach", "Drive a path once: makes a route of it");
  CLI::App* replay_app = app.add_subcommand("replay", "Follow a route");
  CLI::App* serve_app =
      app.add_subcommand("serve", "Stay available: follow the routes that operators send it along");
  CLI::App* fetch_app =
      app.add_subcommand("fetch", "Bring a route into the own store without following it");
  CLI::App* deliver_app =
      app.add_subcommand("deliver", "Send a server what earlier runs taught and could not deliver");
  CLI::App* teachings_app =
      app.add_subcommand("teachings", "List what is in the store, and what of it was cut off");
  agent::AddTeachOptions(*teach_app, teach);
  agent::AddReplayOptions(*replay_app, replay);
  agent::AddServeOptions(*serve_app, serve);
  agent::AddFetchOptions(*fetch_app, fetch);
  agent::AddDeliverOptions(*deliver_app, deliver);
  CLI::App* health_app = program::AddHeartbeat(app, options.common);
  if (const auto ended = program::Parse(app, argc, argv)) return *ended;
  if (health_app->parsed()) return program::RunHealth(app, options.common);
  if (options.common.name.empty()) {
    const bool follows = replay_app->parsed() || serve_app->parsed() || fetch_app->parsed();
    options.common.name = follows ? "follower" : "scout";
  }
  program::KeepFreedMemory();
  program::SetUpLog(options.common);
  const program::StopSignal stop;
  const auto status = teach_app->parsed()       ? agent::RunTeach(options, teach)
                      : replay_app->parsed()    ? agent::RunReplay(options, replay)
                      : serve_app->parsed()     ? agent::RunServe(options, serve)
                      : fetch_app->parsed()     ? agent::RunFetch(options, fetch)
                      : teachings_app->parsed() ? agent::RunTeachings(options)
                                                : agent::RunDeliver(options, deliver);
  return status ? *status : program::Complain(app, status.error());
}

}  // namespace

int main(int argc, char** argv) {
  return program::RunMain("trailcast-agent", [&] { return Run(argc, argv); });
}
