// This is `trailcast fleet`.
#include <chrono>
#include <cstdio>
#include <memory>
#include <sstream>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "services/base/time.h"
#include "services/exchange/bounds.h"
#include "services/fleet/mission_question.h"
#include "services/fleet/operator_peer.h"
#include "services/fleet/robots_there.h"
#include "services/program/json.h"
#include "services/program/live_lines.h"
#include "services/program/stop_signal.h"
#include "services/tool/commands/command.h"

namespace trailcast::tool {
namespace {

constexpr const char* kFleetExamples =
    "Examples:\n"
    "  trailcast fleet                        # robots that are heard, battery, radio, version\n"
    "  trailcast fleet --watch                # the same, drawn anew each second until Ctrl-C\n"
    "  trailcast fleet --json | jq '.[] | select(.battery_percent < 20).robot'\n"
    "One that is not heard is listed as offline where a server has it on a mission.\n"
    "Exit status: 0; 1 nobody was heard (not with --watch); 2 wrong usage.";

struct FleetOptions {
  double listen_s = 3.0;
  bool json = false;
  bool watch = false;
};

constexpr const char* kNobodyIsHeard =
    "no robot was heard: do its agent and this program have the same --domain and --dds-tag?";

std::vector<std::string> LinesOf(const fleet::RobotsThere& robots) {
  if (robots.size() == 0) return {kNobodyIsHeard};
  std::vector<std::string> lines;
  std::istringstream text(robots.Text());
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  return lines;
}

// Shows what is known a second after it has begun and each second from then on.
class FleetWatch {
 public:
  using Time = std::chrono::steady_clock::time_point;
  FleetWatch(bool json, Time now) : json_(json), next_(now + kEvery) {}

  void Look(const fleet::RobotsThere& robots, Time now) {
    if (now < next_) return;
    next_ = now + kEvery;
    if (!json_) return live_.Show(LinesOf(robots));
    std::fputs((program::OneLine(robots.Json()) + "\n").c_str(), stdout);
    std::fflush(stdout);
  }

 private:
  static constexpr std::chrono::seconds kEvery{1};
  bool json_;
  Time next_;
  program::LiveLines live_{stdout};
};

int Run(const CLI::App& app, const program::CommonOptions& common, const FleetOptions& options) {
  program::CommonOptions network = common;
  // In a star only servers hear robots.
  if (network.discovery == "auto") network.discovery = "mesh";
  const program::StopSignal stop;
  const auto peer = fleet::JoinAsOperator(
      network, {.write = {exchange::Topic::kMissionRequests},
                .read = {exchange::Topic::kAgents, exchange::Topic::kMissionReplies}});
  if (!peer) return program::Complain(app, peer.error());
  fleet::RobotsThere robots;
  exchange::MissionRequest newest{.client = peer->self};
  newest.query.page_size = exchange::kMaxMissionsPerReply;
  fleet::MissionQuestion question(std::move(newest));
  auto now = std::chrono::steady_clock::now();
  FleetWatch watch(options.json, now);
  const auto until = now + ToMilliseconds(options.listen_s);
  for (; (options.watch || now < until) && !program::StopSignal::requested();
       now = std::chrono::steady_clock::now()) {
    question.Ask(*peer->exchange, now);
    for (const exchange::Message& message : peer->exchange->Take(std::chrono::milliseconds(100))) {
      const bool is_reply = std::holds_alternative<exchange::MissionReply>(message);
      if (!is_reply || question.AnswerIn(message) != nullptr) robots.Hear(message);
    }
    if (options.watch) watch.Look(robots, now);
  }
  if (options.watch) return program::kExitOk;
  std::fputs((options.json ? program::Indented(robots.Json()) : robots.Text()).c_str(), stdout);
  if (robots.any_heard()) return program::kExitOk;
  std::fprintf(stderr, "%s\n", kNobodyIsHeard);
  return program::kExitFailure;
}

}  // namespace

Command AddFleetCommand(CLI::App& parent, const program::CommonOptions& common) {
  auto options = std::make_shared<FleetOptions>();
  CLI::App* app = parent.add_subcommand(
      "fleet", "List robots that are heard: what they do, how they are, what they say");
  app->footer(kFleetExamples);
  app->add_flag("--json", options->json, "For programs");
  CLI::Option* watch =
      app->add_flag("--watch", options->watch,
                    "Goes on until Ctrl-C; with --json, an array on a line each second");
  app->add_option("--listen", options->listen_s,
                  "Seconds; a hundred robots speak once a second each")
      ->capture_default_str()
      ->excludes(watch)
      ->check(CLI::Range(0.5, 3600.0));
  return {app, [app, options, &common] { return Run(*app, common, *options); }};
}

}  // namespace trailcast::tool
