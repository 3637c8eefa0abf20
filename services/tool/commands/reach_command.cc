// This is `trailcast reach`.
#include <chrono>
#include <cstdio>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "services/base/time.h"
#include "services/exchange/topics.h"
#include "services/fleet/operator_peer.h"
#include "services/fleet/reach.h"
#include "services/program/json.h"
#include "services/program/stop_signal.h"
#include "services/tool/commands/command.h"

namespace trailcast::tool {
namespace {

constexpr const char* kReachExamples =
    "Examples:\n"
    "  trailcast reach                        # all that anybody hears\n"
    "  trailcast reach server robot1 robot2   # these have to be there; over when all is well\n"
    "  trailcast reach --server-address 10.9.0.1          # where there is no multicast\n"
    "  trailcast reach --json | jq -r '.troubles[].what'\n"
    "\n"
    "All are asked, directly and through servers, whom they hear: since when without a break\n"
    "(FOR), how long ago last (LAST), how long a question and its answer took (THERE+BACK, the\n"
    "shortest), how long the last status was under way by the clocks of both (LATE: below 0 or\n"
    "much above half of THERE+BACK, these differ), from which address and over which network\n"
    "interface of who hears (AT). Servers and all others have to hear each other, and members of\n"
    "a mesh one another; where one does not, it is said what to do. This program is in the table\n"
    "under its own name.\n"
    "\n"
    "Exit status: 0 all hear each other; 1 some do not, or nobody is there; 2 wrong usage.";

struct ReachOptions {
  double listen_s = 5.0;
  bool json = false;
  std::vector<std::string> expected;
};

// With an agent to wait for, the survey ends as soon as all is well.
fleet::Reach Survey(exchange::RouteExchange& exchange, const AgentId& self,
                    const ReachOptions& options) {
  using Clock = std::chrono::steady_clock;
  constexpr std::chrono::milliseconds kAskEvery{500};
  std::set<AgentId> expected;
  for (const std::string& name : options.expected) expected.insert(AgentId(name));
  fleet::ReachSurvey survey(self, std::move(expected));
  const auto until = Clock::now() + ToMilliseconds(options.listen_s);
  auto ask_at = Clock::now();
  while (Clock::now() < until && !program::StopSignal::requested()) {
    if (Clock::now() >= ask_at) {
      // A question that cannot be handed over is repeated.
      (void)exchange.Publish(survey.Ask(Clock::now()));
      ask_at = Clock::now() + kAskEvery;
    }
    for (const exchange::Message& message : exchange.Take(std::chrono::milliseconds(50))) {
      survey.Hear(message, Clock::now());
    }
    if (options.expected.empty()) continue;
    fleet::Reach reach = survey.Result(Clock::now());
    if (reach.complete() && fleet::IsMeasured(reach)) return reach;
  }
  return survey.Result(Clock::now());
}

int Run(const CLI::App& app, const program::CommonOptions& common, const ReachOptions& options) {
  program::CommonOptions network = common;
  // In a star only servers hear robots.
  if (network.discovery == "auto") network.discovery = "mesh";
  const program::StopSignal stop;
  const auto peer = fleet::JoinAsOperator(network, exchange::ReachTopics());
  if (!peer) return program::Complain(app, peer.error());
  const fleet::Reach reach = Survey(*peer->exchange, peer->self, options);
  std::fputs(
      (options.json ? program::Indented(fleet::ReachJson(reach)) : fleet::ReachText(reach)).c_str(),
      stdout);
  if (reach.complete()) return program::kExitOk;
  if (reach.members.empty()) {
    std::fputs(
        "nobody was heard: do servers, robots and this program have the same --domain and "
        "--dds-tag? Without multicast, say --server-address\n",
        stderr);
  }
  return program::kExitFailure;
}

}  // namespace

Command AddReachCommand(CLI::App& parent, const program::CommonOptions& common) {
  auto options = std::make_shared<ReachOptions>();
  CLI::App* app = parent.add_subcommand(
      "reach", "Ask servers and robots whom they hear, how late and over what; say who cannot");
  app->footer(kReachExamples);
  app->add_flag("--json", options->json, "For programs");
  app->add_option("--listen", options->listen_s, "Seconds; all are asked twice in each")
      ->capture_default_str()
      ->check(CLI::Range(1.0, 3600.0));
  app->add_option("names", options->expected, "Servers and robots that have to be there")
      ->check(program::NameValidator());
  return {app, [app, options, &common] { return Run(*app, common, *options); }};
}

}  // namespace trailcast::tool
