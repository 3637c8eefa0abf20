// These are `trailcast pause`, `resume`, `cancel`, `stop`, `release`, `home` and `end`.
#include <fmt/format.h>

#include <cstdio>
#include <memory>

#include "services/base/time.h"
#include "services/fleet/now_client.h"
#include "services/fleet/operator_peer.h"
#include "services/fleet/routes/transfer.h"
#include "services/program/json.h"
#include "services/tool/commands/address_validator.h"
#include "services/tool/commands/command.h"

namespace trailcast::tool {
namespace {

using exchange::NowOrder;
using exchange::NowWhom;

struct NowOptions {
  std::vector<std::string> robots;
  std::string route;
  bool all = false;
  std::string reason;
  bool json = false;
  double timeout_s = 5.0;
};

constexpr const char* kNowExamples =
    "Examples:\n"
    "  trailcast pause robot2 --reason 'somebody walks here'\n"
    "  trailcast stop --all                   # and none drives before it is released and resumed\n"
    "  trailcast release robot2 && trailcast resume robot2\n"
    "  trailcast home --all                   # to the nearest place of that kind, each\n"
    "Robots that follow with --server obey, at once, and their wheels stand with the next "
    "picture.\n"
    "This is no emergency stop, and no safety-rated one: a robot that is out of reach drives on.\n"
    "Robots that a server has on a mission are named, too, where they are out of reach.\n"
    "Exit status: 0 all obey; 1 somebody does not, or did not answer; 2 wrong usage.";

std::vector<fleet::NowTarget> TargetsOf(const NowOptions& options) {
  std::vector<fleet::NowTarget> targets;
  for (const std::string& robot : options.robots) targets.push_back({NowWhom::kRobot, robot});
  if (!options.route.empty()) targets.push_back({NowWhom::kOnRoute, options.route});
  if (options.all) targets.push_back({NowWhom::kAll, ""});
  return targets;
}

int Run(const CLI::App& app, const program::CommonOptions& common, NowOrder order,
        const NowOptions& options) {
  const auto peer = fleet::JoinAsOperator(common, exchange::DispatcherTopics());
  if (!peer) return program::Complain(app, peer.error());
  const auto words = fleet::TellRobots(*peer->exchange, peer->self, order, TargetsOf(options),
                                       options.reason, ToMilliseconds(options.timeout_s));
  if (!words) return program::Complain(app, words.error());
  std::fputs((options.json ? program::Indented(fleet::WordsJson(*words)) : fleet::WordsText(*words))
                 .c_str(),
             stdout);
  const fleet::Obeyed obeyed = fleet::ObeyedBy(*words);
  if (order == NowOrder::kStop && obeyed == fleet::Obeyed::kUnanswered) {
    fmt::print(
        stderr,
        "{} Use the red button on the robot; '--timeout 600' tells it again for ten minutes.\n",
        fleet::StandText(*words));
  }
  return obeyed == fleet::Obeyed::kByAll ? program::kExitOk : program::kExitFailure;
}

Command AddOne(CLI::App& parent, const program::CommonOptions& common, NowOrder order,
               const char* help) {
  auto options = std::make_shared<NowOptions>();
  CLI::App* app = parent.add_subcommand(exchange::ToString(order), help);
  app->footer(kNowExamples);
  auto* robots =
      app->add_option("ROBOT", options->robots,
                      "Their names, as --name of their agents; cancel, stop and resume also take "
                      "'@GROUP': what waits for a free robot of it");
  const bool for_groups =
      order == NowOrder::kCancel || order == NowOrder::kStop || order == NowOrder::kResume;
  robots->check(for_groups ? AddressValidator() : program::NameValidator());
  auto* route = app->add_option("--route", options->route, "Those on the route of this name");
  route->check(program::NameValidator());
  auto* all = app->add_flag("--all", options->all, "Every robot");
  all->excludes(robots)->excludes(route);
  app->add_option("--reason", options->reason, "A line for people, at most 512 bytes");
  app->add_flag("--json", options->json, "For programs");
  app->add_option("--timeout", options->timeout_s, "Seconds to wait for their answers")
      ->capture_default_str()
      ->check(CLI::Range(0.1, 3600.0));
  app->callback([robots, route, all] {
    if (robots->count() + route->count() + all->count() == 0) {
      throw CLI::RequiredError("ROBOT, --route or --all");
    }
  });
  return {app, [app, options, order, &common] { return Run(*app, common, order, *options); }};
}

}  // namespace

std::vector<Command> AddNowCommands(CLI::App& parent, const program::CommonOptions& common) {
  return {AddOne(parent, common, NowOrder::kPause, "Have robots stand where they are"),
          AddOne(parent, common, NowOrder::kResume,
                 "Have paused robots go on, and queues that are held"),
          AddOne(parent, common, NowOrder::kCancel,
                 "Have robots end what they do, and what is queued for them"),
          AddOne(parent, common, NowOrder::kStop,
                 "Have robots stand, also after a restart, until they are released"),
          AddOne(parent, common, NowOrder::kRelease,
                 "Release stopped robots: they stand until they are told to resume"),
          AddOne(parent, common, NowOrder::kHome,
                 "Have robots end what they do and go home, and hold their queues until resumed"),
          AddOne(parent, common, NowOrder::kEnd,
                 "End what robots are teaching: the route is complete ('cancel' discards it)")};
}

}  // namespace trailcast::tool
