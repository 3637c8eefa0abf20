#include <chrono>
#include <cstdio>
#include <memory>
#include <string>

#include "services/base/local_time.h"
#include "services/base/time.h"
#include "services/base/unix_time.h"
#include "services/exchange/bounds.h"
#include "services/fleet/network_client.h"
#include "services/fleet/operator_peer.h"
#include "services/fleet/routes/catalog_client.h"
#include "services/fleet/routes/route_export.h"
#include "services/fleet/routes/transfer.h"
#include "services/program/json.h"
#include "services/program/place_options.h"
#include "services/program/stop_signal.h"
#include "services/route/no_route.h"
#include "services/route/query_words.h"
#include "services/tool/commands/command.h"
#include "services/tool/commands/route_diff.h"
#include "services/tool/commands/route_edits.h"
#include "services/tool/commands/time_spans.h"

namespace trailcast::tool {
namespace {

struct RoutesOptions {
  route::RouteQuery query;
  std::string state;
  std::string sort = "newest";
  std::optional<route::Place> near;
  double within_m = 50.0;
  double newer_than_s = 0.0;
  double older_than_s = 0.0;
  std::string since;  // empty unless changes are asked for
  std::size_t limit = 100;
  bool json = false;
  bool looked_into = false;
  double timeout_s = 5.0;
};

constexpr const char* kRoutesExamples =
    "Examples:\n"
    "  trailcast routes\n"
    "  trailcast routes --name aisle-3 --json\n"
    "  trailcast routes --name aisle-3 --long     # where it is weak, rough, steep\n"
    "  trailcast routes --prefix barn- --tag night --sort longest\n"
    "  trailcast routes --near-gps 48.137,11.575 --within 200 --newer-than 7d\n"
    "  trailcast routes --since monday            # what was changed: routes, junctions, closed "
    "parts\n"
    "  trailcast routes --network-interface lo --timeout 2\n"
    "  trailcast routes activate aisle-3          # followers take the newest revision now\n"
    "  trailcast routes activate a3f9c21@2        # or this one, by the id that is listed\n"
    "  trailcast routes rollback aisle-3          # and the one before again\n"
    "  trailcast routes tag aisle-3 night wet\n"
    "  trailcast routes diff aisle-3@1 aisle-3@3  # where the place has changed";

std::int64_t Before(std::int64_t now_unix_ms, double age_s) {
  return now_unix_ms - static_cast<std::int64_t>(age_s * 1000.0);
}

route::RouteQuery QueryOf(const RoutesOptions& options, std::int64_t now_unix_ms) {
  route::RouteQuery query = options.query;
  query.order = route::OrderWords().at(options.sort);
  if (!options.state.empty()) {
    const route::StateWord& word = route::StateWords().at(options.state);
    query.state = word.state;
    query.standing = word.standing;
  }
  if (options.near) query.near = {*options.near, options.within_m};
  if (options.newer_than_s > 0.0) {
    query.taught_from_unix_ms = Before(now_unix_ms, options.newer_than_s);
  }
  if (options.older_than_s > 0.0) {
    query.taught_until_unix_ms = Before(now_unix_ms, options.older_than_s);
  }
  return query;
}

// Reports that no route has that name, with the names that there are, as a failure. The query may
// also exclude a route of that name.
int ShowNone(const CLI::App& app, const route::RouteQuery& query,
             const exchange::CatalogReply& reply) {
  const std::string holder = fmt::format("server '{}'", reply.server.value());
  const route::RouteQuery name_alone{.name = query.name, .order = query.order};
  if (query == name_alone) {
    return program::Complain(
        app, {ErrorCode::kNotFound, route::NoRouteText(holder, query.name, reply.similar_names)});
  }
  return program::Complain(
      app, {ErrorCode::kNotFound,
            fmt::format("{} has no route '{}' of which all that is asked for is true: 'trailcast "
                        "routes --name {}' lists it, if there is one",
                        holder, query.name, query.name)});
}

// Studies the complete ones among these routes.
Result<fleet::RouteStudies> Study(fleet::OperatorPeer& peer,
                                  const std::vector<route::RouteInfo>& routes,
                                  std::chrono::milliseconds timeout) {
  const program::StopSignal stop;
  fleet::RouteStudies studies;
  for (const route::RouteInfo& info : routes) {
    if (info.state != route::RouteState::kComplete) continue;
    fleet::TransferProgress progress(fmt::format("looking into '{}'", info.name), info.bytes);
    fleet::TransferWatch watch;
    watch.timeout = timeout;
    watch.stop = [] { return program::StopSignal::requested(); };
    watch.progress = [&progress](std::uint64_t done) { progress.Show(done); };
    auto study = fleet::StudyRoute(peer, info, watch);
    if (!study) return tl::unexpected(study.error());
    studies.emplace(info.key, std::move(*study));
  }
  return studies;
}

std::string TextOf(const exchange::CatalogReply& reply, const fleet::RouteStudies& studies,
                   bool json, std::int64_t now_unix_ms) {
  if (json) return program::Indented(fleet::RoutesJson(reply, studies));
  std::string text = fleet::RoutesTable(reply, now_unix_ms);
  for (const route::RouteInfo& info : reply.page.routes) {
    const auto study = studies.find(info.key);
    if (study == studies.end()) continue;
    text += fleet::WeakPlacesText(info, study->second) + fleet::GroundText(info, study->second);
  }
  return text;
}

int RunSince(const CLI::App& app, const program::CommonOptions& common,
             const RoutesOptions& options) {
  const auto since_unix_ms = ParseSince(options.since, NowUnixMs());
  if (!since_unix_ms) return program::Complain(app, since_unix_ms.error());
  const auto peer = fleet::JoinAsOperator(common, exchange::NetworkTopics());
  if (!peer) return program::Complain(app, peer.error());
  const auto history = fleet::AskForChanges(*peer->exchange, peer->self, *since_unix_ms,
                                            ToMilliseconds(options.timeout_s));
  if (!history) return program::Complain(app, history.error());
  const std::string text = options.json
                               ? program::Indented(fleet::ChangesJson(*history, options.limit))
                               : fleet::ChangesText(*history, *since_unix_ms, options.limit);
  std::fputs(text.c_str(), stdout);
  return program::kExitOk;
}

int Run(const CLI::App& app, const program::CommonOptions& common, const RoutesOptions& options) {
  if (!options.since.empty()) return RunSince(app, common, options);
  const std::int64_t now_unix_ms = NowUnixMs();
  const route::RouteQuery query = QueryOf(options, now_unix_ms);
  if (auto possible = exchange::CheckQuery(query); !possible) {
    return program::Complain(app, possible.error());
  }
  auto peer = fleet::JoinAsOperator(
      common, options.looked_into ? fleet::ExporterTopics() : exchange::ObserverTopics());
  if (!peer) return program::Complain(app, peer.error());
  const auto timeout = ToMilliseconds(options.timeout_s);
  const auto reply =
      fleet::AskForRoutes(*peer->exchange, peer->self, query, options.limit, timeout);
  if (!reply) return program::Complain(app, reply.error());
  const std::vector<route::RouteInfo>& routes = reply->page.routes;
  if (!query.name.empty() && routes.empty()) return ShowNone(app, query, *reply);
  Result<fleet::RouteStudies> studies;
  if (options.looked_into) studies = Study(*peer, routes, timeout);
  if (!studies) return program::Complain(app, studies.error());
  std::fputs(TextOf(*reply, *studies, options.json, now_unix_ms).c_str(), stdout);
  if (routes.size() < reply->page.total) {
    std::fputs(
        fmt::format("{} of {} routes; --limit shows more\n", routes.size(), reply->page.total)
            .c_str(),
        stderr);
  }
  return program::kExitOk;
}

void AddFilters(CLI::App& app, RoutesOptions& options) {
  route::RouteQuery& query = options.query;
  app.add_option("--name", query.name, "Only the route of this name, or whose id begins so")
      ->check(program::NameValidator());
  app.add_option("--prefix", query.name_prefix, "Only names that begin so")
      ->check(program::NameValidator());
  app.add_option("--tag", query.tags, "Only with this tag; several: with all of them")
      ->check(program::NameValidator())
      ->take_all()
      ->allow_extra_args(false);
  app.add_option("--scout", query.scout, "Only taught by this scout")
      ->check(program::NameValidator());
  app.add_option("--camera", query.camera_prefix, "Only taught by cameras whose name begins so");
  app.add_option("--min-length", query.min_length_m, "Metres")->check(CLI::NonNegativeNumber);
  app.add_option("--max-length", query.max_length_m, "Metres; 0: any")
      ->check(CLI::NonNegativeNumber);
  app.add_option("--newer-than", options.newer_than_s, "Only taught since: 90min, 12h, 7d; 0: any")
      ->transform(TimeSpan("AGE"));
  app.add_option("--older-than", options.older_than_s, "Only taught before that")
      ->transform(TimeSpan("AGE"));
  app.add_option("--state", options.state, "Only these")
      ->check(CLI::IsMember(&route::StateWords()));
  program::AddPlaceOptions(app, "near", "Only beginning near", options.near);
  app.add_option("--within", options.within_m, "Metres, how near")->check(CLI::PositiveNumber);
}

}  // namespace

Command AddRoutesCommand(CLI::App& parent, const program::CommonOptions& common) {
  auto options = std::make_shared<RoutesOptions>();
  CLI::App* app = parent.add_subcommand("routes", "List the routes that a route server keeps");
  app->footer(kRoutesExamples);
  app->option_defaults()->always_capture_default();
  AddFilters(*app, *options);
  CLI::Option* const since = app->add_option(
      "--since", options->since,
      "Not the routes, but what was changed of them and of how they are joined, and by whom, since "
      "monday, yesterday, 2026-11-23, 09:15, 2026-11-23T09:15, 90min, 12h, 2d, by this terminal's "
      "time zone");
  since->check([](const std::string& text) {
    const auto moment = ParseSince(text, NowUnixMs());
    return moment ? std::string() : moment.error().message;
  });
  // Changes are listed for all routes, so the filters exclude them.
  for (CLI::Option* const filter : app->get_options()) {
    if (filter != since && filter != app->get_help_ptr()) since->excludes(filter);
  }
  app->add_option("--sort", options->sort, "What comes first")
      ->check(CLI::IsMember(&route::OrderWords()));
  app->add_option("--limit", options->limit, "Routes, or changes, to list at most")
      ->check(CLI::Range(1, 10'000'000));
  app->add_flag("--json", options->json, "For programs");
  app->add_flag(
      "--long", options->looked_into,
      "Fetch each route that is listed and tell where followers may be lost, and why, and how "
      "rough and steep its ground is");
  app->add_option("--timeout", options->timeout_s, "Seconds to wait for a server")
      ->check(CLI::Range(0.1, 3600.0));
  std::vector<Command> others = AddRouteEdits(*app, common, options->timeout_s);
  others.push_back(AddRouteDiff(*app, common, options->timeout_s));
  return {app, [app, options, &common, others] {
            for (const Command& other : others) {
              if (other.app->parsed()) return other.run();
            }
            return Run(*app, common, *options);
          }};
}

}  // namespace trailcast::tool
