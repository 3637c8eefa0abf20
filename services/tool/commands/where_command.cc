#include <chrono>
#include <cstdio>
#include <memory>
#include <string>

#include "services/base/time.h"
#include "services/fleet/operator_peer.h"
#include "services/fleet/routes/catalog_client.h"
#include "services/fleet/routes/picture_query.h"
#include "services/fleet/routes/transfer.h"
#include "services/fleet/routes/where_report.h"
#include "services/image/files.h"
#include "services/program/json.h"
#include "services/tool/commands/command.h"

namespace trailcast::tool {
namespace {

struct WhereOptions {
  std::string frame;
  bool json = false;
  double timeout_s = 5.0;
};

constexpr const char* kWhereExamples =
    "Examples:\n"
    "  trailcast where --frame now.png\n"
    "  trailcast where --frame now.png --json --network-interface lo";

Result<route::RouteQuery> QueryOf(const WhereOptions& options) {
  return image::ReadGray(options.frame).and_then([&](const image::GrayImage& frame) {
    return fleet::QueryByPicture(frame, options.frame);
  });
}

int Run(const CLI::App& app, const program::CommonOptions& common, const WhereOptions& options) {
  const auto query = QueryOf(options);
  if (!query) return program::Complain(app, query.error());
  const auto peer = fleet::JoinAsOperator(common, exchange::ObserverTopics());
  if (!peer) return program::Complain(app, peer.error());
  const auto timeout = ToMilliseconds(options.timeout_s);
  const auto reply = fleet::AskCatalog(*peer->exchange, peer->self, *query, timeout);
  if (!reply) return program::Complain(app, reply.error());
  std::fputs((options.json ? program::Indented(fleet::WhereJson(*reply)) : fleet::WhereText(*reply))
                 .c_str(),
             stdout);
  return program::kExitOk;
}

}  // namespace

Command AddWhereCommand(CLI::App& parent, const program::CommonOptions& common) {
  auto options = std::make_shared<WhereOptions>();
  CLI::App* app = parent.add_subcommand(
      "where", "Find the routes, and the places on them, that a picture shows");
  app->footer(kWhereExamples);
  app->option_defaults()->always_capture_default();
  app->add_option("--frame", options->frame, "A picture from the robot's camera")->required();
  app->add_flag("--json", options->json, "For programs");
  app->add_option("--timeout", options->timeout_s, "Seconds to wait for a server")
      ->check(CLI::Range(0.1, 3600.0));
  return {app, [app, options, &common] { return Run(*app, common, *options); }};
}

}  // namespace trailcast::tool
