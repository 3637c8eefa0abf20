#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <memory>
#include <string>

#include "agent/cli/open_exchange.h"
#include "agent/tool/catalog_client.h"
#include "agent/tool/command.h"

namespace trailcast::tool {
namespace {

struct RoutesOptions {
  std::string name;
  bool json = false;
  double timeout_s = 5.0;
};

constexpr const char* kExamples =
    "Examples:\n"
    "  trailcast routes\n"
    "  trailcast routes --name aisle-3 --json\n"
    "  trailcast routes --network-interface lo --timeout 2";

std::int64_t NowUnixMs() {
  return std::chrono::duration_cast<std::chrono::milliseconds>(
             std::chrono::system_clock::now().time_since_epoch())
      .count();
}

// No route of that name is a failure that says what there is.
int ShowNone(const CLI::App& app, const std::string& name, const exchange::CatalogReply& reply) {
  std::string similar;
  for (const std::string& each : reply.similar_names) {
    similar += fmt::format("{}{}", similar.empty() ? "; there is " : ", ", each);
  }
  return cli::Complain(
      app, {ErrorCode::kNotFound,
            fmt::format("server {} has no route '{}'{}", reply.server.value(), name, similar)});
}

int Run(const CLI::App& app, const cli::CommonOptions& common, const RoutesOptions& options) {
  // Two operators may ask at the same time.
  cli::CommonOptions network = common;
  network.name = fmt::format("{}-{}", common.name, getpid());
  auto exchange = cli::OpenExchange(network, exchange::OperatorTopics());
  if (!exchange) return cli::Complain(app, exchange.error());
  const auto timeout = std::chrono::duration_cast<std::chrono::milliseconds>(
      std::chrono::duration<double>(options.timeout_s));
  const auto reply = AskCatalog(**exchange, AgentId(network.name), options.name, timeout);
  if (!reply) return cli::Complain(app, reply.error());
  if (!options.name.empty() && reply->routes.empty()) return ShowNone(app, options.name, *reply);
  const std::string text =
      options.json ? RoutesJson(reply->routes) : RoutesTable(reply->routes, NowUnixMs());
  std::fputs(text.c_str(), stdout);
  return cli::kExitOk;
}

}  // namespace

Command AddRoutesCommand(CLI::App& parent, const cli::CommonOptions& common) {
  auto options = std::make_shared<RoutesOptions>();
  CLI::App* app = parent.add_subcommand("routes", "List the routes that a route server keeps");
  app->footer(kExamples);
  app->option_defaults()->always_capture_default();
  app->add_option("--name", options->name, "Only the route of this name")
      ->check(cli::NameValidator());
  app->add_flag("--json", options->json, "For programs");
  app->add_option("--timeout", options->timeout_s, "Seconds to wait for a server")
      ->check(CLI::Range(0.1, 3600.0));
  return {app, [app, options, &common] { return Run(*app, common, *options); }};
}

}  // namespace trailcast::tool
