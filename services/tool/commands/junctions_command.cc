// This is `trailcast junctions`.
#include <cstdio>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "services/archive/route_file.h"
#include "services/exchange/route_finder.h"
#include "services/program/json.h"
#include "services/route/digest.h"
#include "services/store/route_store.h"
#include "services/tool/commands/command.h"
#include "services/tool/junctions_report.h"

namespace trailcast::tool {
namespace {

namespace fs = std::filesystem;

struct JunctionsCommandOptions {
  std::vector<std::string> routes;
  fs::path store;
  bool json = false;
};

constexpr const char* kJunctionsExamples =
    "Examples:\n"
    "  trailcast junctions hall.trailcast office.trailcast   # of files, as 'export' writes them\n"
    "  trailcast junctions hall office --store server.db     # no network; no server may have it "
    "open\n"
    "  trailcast junctions hall --store server.db            # of hall with all others there\n"
    "  trailcast junctions --store server.db --json          # of all with all\n"
    "A line says where two routes come to the same place looking the same way, and for how long "
    "they\n"
    "run on together: 'hall@12.0 office@0.4 for 5.3 m, agreed by 43 features, 0.97 sure, straight\n"
    "on'. Where a route comes back to where it was, both are places of it. Of routes taught "
    "without\n"
    "odometry places are seconds of teaching: 'hall@12.0s'. The heading is by how much the second "
    "one\n"
    "looks to the left or right of the first; how far it runs beside it cannot be told.";

using ReadSegment = std::function<Result<route::SegmentPiece>(SegmentIndex)>;

Result<JoinableRoute> ViewsOf(const route::RouteInfo& info, const ReadSegment& read) {
  JoinableRoute found{info, junctions::RouteViews(info.image_width_px)};
  for (std::uint32_t i = 0; i < info.segment_count; ++i) {
    const auto piece = read(SegmentIndex(i));
    if (!piece) return tl::unexpected(piece.error());
    const auto segment = route::Open(*piece);
    if (!segment) return tl::unexpected(segment.error());
    found.views.Add(*segment);
  }
  return found;
}

Result<std::vector<JoinableRoute>> FromFiles(const std::vector<std::string>& paths) {
  std::vector<JoinableRoute> routes;
  for (const std::string& path : paths) {
    const auto file = archive::RouteFile::Open(path);
    if (!file) return tl::unexpected(file.error());
    auto found =
        ViewsOf(file->info(), [&](SegmentIndex index) { return file->ReadSegment(index); });
    if (!found) return tl::unexpected(found.error());
    routes.push_back(std::move(*found));
  }
  return routes;
}

// Returns the revision that followers would take, as far as it is complete.
Result<route::RouteInfo> Meant(store::RouteStore& store, const std::string& text) {
  const auto ref = route::ParseRouteRef(text);
  if (!ref) return tl::unexpected(ref.error());
  const auto infos = store.FindMeant(ref->route);
  if (!infos) return tl::unexpected(infos.error());
  auto found = exchange::ChooseMeant(ref->route, *infos, {.number = ref->revision});
  if (!found) return tl::unexpected(found.error());
  auto& chosen = *found;
  if (!chosen && !infos->empty()) {
    return tl::unexpected(
        exchange::NotMeant("the store", ref->route, *infos, {.number = ref->revision}));
  }
  if (!chosen || chosen->state != route::RouteState::kComplete) {
    return Fail(ErrorCode::kNotFound,
                "the store has no complete route '{}': see 'trailcast routes'", text);
  }
  return std::move(*chosen);
}

Result<std::vector<route::RouteInfo>> InUse(store::RouteStore& store) {
  const auto infos = store.ListRoutes();
  if (!infos) return tl::unexpected(infos.error());
  std::map<RouteId, std::vector<route::RouteInfo>> revisions;
  for (const route::RouteInfo& info : *infos) revisions[info.key.route].push_back(info);
  std::vector<route::RouteInfo> in_use;
  for (const auto& [id, all] : revisions) {
    auto chosen = exchange::ChooseRoute(all);
    if (chosen && chosen->state == route::RouteState::kComplete) {
      in_use.push_back(std::move(*chosen));
    }
  }
  return in_use;
}

Result<std::vector<JoinableRoute>> FromStore(const JunctionsCommandOptions& options) {
  auto store = store::OpenExistingSqliteStore(options.store);
  if (!store) return tl::unexpected(store.error());
  std::vector<route::RouteInfo> infos;
  for (const std::string& text : options.routes) {
    auto info = Meant(**store, text);
    if (!info) return tl::unexpected(info.error());
    infos.push_back(std::move(*info));
  }
  if (infos.size() < 2) {
    auto others = InUse(**store);
    if (!others) return tl::unexpected(others.error());
    if (!infos.empty()) {
      std::erase_if(*others, [&](const route::RouteInfo& other) {
        return other.key.route == infos.front().key.route;
      });
    }
    infos.insert(infos.end(), others->begin(), others->end());
  }
  std::vector<JoinableRoute> routes;
  for (const route::RouteInfo& info : infos) {
    auto found =
        ViewsOf(info, [&](SegmentIndex index) { return (*store)->ReadSegment(info.key, index); });
    if (!found) return tl::unexpected(found.error());
    routes.push_back(std::move(*found));
  }
  return routes;
}

int Run(const CLI::App& app, const JunctionsCommandOptions& options) {
  if (options.store.empty() && options.routes.empty()) {
    program::Complain(app, {ErrorCode::kInvalidArgument, "give route files, or --store"});
    return program::kExitUsage;
  }
  const auto routes = options.store.empty() ? FromFiles(options.routes) : FromStore(options);
  if (!routes) return program::Complain(app, routes.error());
  const bool only_first = !options.store.empty() && options.routes.size() == 1;
  const auto found = FindAllJunctions(*routes, only_first);
  std::fputs((options.json ? program::Indented(JunctionsJson(*routes, found))
                           : JunctionsText(*routes, found))
                 .c_str(),
             stdout);
  return program::kExitOk;
}

}  // namespace

Command AddJunctionsCommand(CLI::App& parent) {
  auto options = std::make_shared<JunctionsCommandOptions>();
  CLI::App* app = parent.add_subcommand(
      "junctions", "Find where routes come to the same place looking the same way");
  app->footer(kJunctionsExamples);
  app->option_defaults()->always_capture_default();
  app->add_option("route", options->routes,
                  "Route files; with --store names or ids, '@2' behind one is its revision 2");
  app->add_option("--store", options->store, "Routes of this store file");
  app->add_flag("--json", options->json, "For programs");
  return {app, [app, options] { return Run(*app, *options); }};
}

}  // namespace trailcast::tool
