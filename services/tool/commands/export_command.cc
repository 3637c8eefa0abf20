#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

#include "services/base/time.h"
#include "services/catalog/catalog.h"
#include "services/exchange/bounds.h"
#include "services/fleet/operator_peer.h"
#include "services/fleet/routes/catalog_client.h"
#include "services/fleet/routes/route_export.h"
#include "services/fleet/routes/route_summary.h"
#include "services/program/stop_signal.h"
#include "services/route/labels.h"
#include "services/route/route_ref.h"
#include "services/tool/commands/command.h"

namespace trailcast::tool {
namespace {

namespace fs = std::filesystem;
using archive::RouteFileWriter;

struct ExportOptions {
  std::string route;
  exchange::RevisionChoice which;
  fs::path out;
  fs::path store;
  bool force = false;
  double timeout_s = 10.0;
};

constexpr const char* kExportExamples =
    "Examples:\n"
    "  trailcast export hall                          # hall.trailcast, from a route server\n"
    "  trailcast export hall@2 --out /media/stick/hall-2.trailcast\n"
    "  trailcast export a3f9c21                       # by its id, where two scouts taught a hall\n"
    "  trailcast export hall --store scout.db         # no network; no server may have it open";

struct Exported {
  route::RouteInfo info;
  std::uint64_t bytes = 0;
};

Result<RouteFileWriter> OpenFile(const ExportOptions& options, const route::RouteInfo& info) {
  const fs::path out = options.out.empty() ? fs::path(info.name + ".trailcast") : options.out;
  const auto existing =
      options.force ? RouteFileWriter::Existing::kReplace : RouteFileWriter::Existing::kKeep;
  return RouteFileWriter::Create(out, info, existing);
}

Result<Exported> FromStore(const ExportOptions& options) {
  auto store = store::OpenExistingSqliteStore(options.store);
  if (!store) return tl::unexpected(store.error());
  const std::string holder = "route store " + options.store.string();
  const exchange::CatalogReply reply =
      catalog::Answer({.client = {}, .request = 0, .query = {.name = options.route}}, {}, **store);
  if (!reply.error.empty()) return Fail(ErrorCode::kUnavailable, "{}: {}", holder, reply.error);
  auto info = fleet::ChooseForExport(reply, options.route, options.which, holder);
  if (!info) return tl::unexpected(info.error());
  auto file = OpenFile(options, *info);
  if (!file) return tl::unexpected(file.error());
  const auto bytes = fleet::ExportFromStore(**store, *info, std::move(*file));
  if (!bytes) return tl::unexpected(bytes.error());
  return Exported{std::move(*info), *bytes};
}

Result<Exported> FromServer(const program::CommonOptions& common, const ExportOptions& options) {
  auto peer = fleet::JoinAsOperator(common, fleet::ExporterTopics());
  if (!peer) return tl::unexpected(peer.error());
  fleet::TransferWatch watch;
  watch.timeout = ToMilliseconds(options.timeout_s);
  const auto reply = fleet::AskForRoutes(*peer->exchange, peer->self, {.name = options.route},
                                         exchange::kMaxRoutesPerReply, watch.timeout);
  if (!reply) return tl::unexpected(reply.error());
  auto info = fleet::ChooseForExport(*reply, options.route, options.which,
                                     fmt::format("server '{}'", reply->server.value()));
  if (!info) return tl::unexpected(info.error());
  // From here on there is something to clean up.
  const program::StopSignal stop;
  watch.stop = [] { return program::StopSignal::requested(); };
  auto file = OpenFile(options, *info);
  if (!file) return tl::unexpected(file.error());
  fleet::TransferProgress progress(fmt::format("fetching '{}'", info->name), info->bytes);
  watch.progress = [&progress](std::uint64_t done) { progress.Show(done); };
  const auto bytes = fleet::ExportFromServer(*peer, *info, std::move(*file), watch);
  if (!bytes) return tl::unexpected(bytes.error());
  return Exported{std::move(*info), *bytes};
}

int Run(const CLI::App& app, const program::CommonOptions& common, ExportOptions options) {
  const auto ref = program::WithRevision(options.route, options.which.number);
  if (!ref) return program::Complain(app, ref.error());
  options.route = ref->route;
  options.which.number = ref->revision;
  const auto exported = options.store.empty() ? FromServer(common, options) : FromStore(options);
  if (!exported) return program::Complain(app, exported.error());
  const route::RouteInfo& info = exported->info;
  const std::string out = options.out.empty() ? info.name + ".trailcast" : options.out.string();
  fmt::print("{}: {}, id {}, {} segments, {}, {} bytes\n", out, route::Describe(info),
             route::ShortIds().Of(info), info.segment_count, fleet::LengthText(info),
             exported->bytes);
  return program::kExitOk;
}

}  // namespace

Command AddExportCommand(CLI::App& parent, const program::CommonOptions& common) {
  auto options = std::make_shared<ExportOptions>();
  CLI::App* app = parent.add_subcommand("export", "Write a complete route to a file");
  app->footer(kExportExamples);
  app->option_defaults()->always_capture_default();
  app->add_option("route", options->route,
                  "Its name, or its id, of which 7 digits or more will do; '@2' behind it is its "
                  "revision 2")
      ->required()
      ->check(program::RouteRefValidator());
  app->add_option("--revision", options->which.number, "This one; else the active one")
      ->check(program::RevisionValidator());
  app->add_option("--scout", options->which.scout,
                  "Of several routes of this name that of this scout")
      ->check(program::NameValidator());
  app->add_option("--out", options->out, "The file; else NAME.trailcast here");
  app->add_flag("--force", options->force, "Replace the file if it is there already");
  app->add_option("--store", options->store, "From this store file instead of a route server");
  app->add_option("--timeout", options->timeout_s, "Seconds to wait for a server to go on")
      ->check(CLI::Range(0.1, 3600.0));
  return {app, [app, options, &common] { return Run(*app, common, *options); }};
}

}  // namespace trailcast::tool
