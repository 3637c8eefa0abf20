// This is `trailcast routes diff`.
#include "services/tool/commands/route_diff.h"

#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "services/base/time.h"
#include "services/exchange/bounds.h"
#include "services/fleet/operator_peer.h"
#include "services/fleet/routes/catalog_client.h"
#include "services/fleet/routes/route_export.h"
#include "services/fleet/routes/transfer.h"
#include "services/program/json.h"
#include "services/program/stop_signal.h"
#include "services/route/codec.h"
#include "services/route/route_ref.h"
#include "services/tool/diff_report.h"

namespace trailcast::tool {
namespace {

struct DiffOptions {
  std::string a;
  std::string b;
  std::string plot;
  bool json = false;
};

constexpr const char* kRouteDiffExamples =
    "Examples:\n"
    "  trailcast routes diff hall@1 hall@3 --plot diff.png\n"
    "  trailcast routes diff hall aisle       # the revisions that robots follow\n"
    "Where the place has changed, along the first one: which share of its features the second "
    "still\n"
    "has, how many went and came, and how far the path was moved. Of a route that robots "
    "refreshed\n"
    "each feature is compared with itself; any others by what was seen on the way, where the same\n"
    "feature is found again less surely: only a section that has clearly less than the route as a\n"
    "whole is told. Exit status: 0 compared; 1 not, and why, or they go other ways; 2 wrong usage.";

struct Fetched {
  route::RouteInfo info;
  std::vector<route::Segment> segments;
};

Result<Fetched> Fetch(fleet::OperatorPeer& peer, const std::string& words,
                      fleet::TransferWatch watch) {
  const auto ref = route::ParseRouteRef(words);
  if (!ref) return tl::unexpected(ref.error());
  const auto reply = fleet::AskForRoutes(*peer.exchange, peer.self, {.name = ref->route},
                                         exchange::kMaxRoutesPerReply, watch.timeout);
  if (!reply) return tl::unexpected(reply.error());
  auto info = fleet::ChooseForExport(*reply, ref->route, {.number = ref->revision},
                                     fmt::format("server '{}'", reply->server.value()));
  if (!info) return tl::unexpected(info.error());
  Fetched fetched{.info = *std::move(info), .segments = {}};
  fleet::TransferProgress progress(fmt::format("fetching '{}'", words), fetched.info.bytes);
  watch.progress = [&progress](std::uint64_t done) { progress.Show(done); };
  const auto all = fleet::FetchInOrder(
      peer, fetched.info, watch, [&](const route::SegmentPiece& piece) -> Result<void> {
        auto segment = route::Decode(piece.bytes);
        if (!segment) return Wrap(segment.error(), fmt::format("segment {}", piece.index.value()));
        fetched.segments.push_back(*std::move(segment));
        return {};
      });
  if (!all) return tl::unexpected(all.error());
  return fetched;
}

Result<RouteDiff> Compare(const program::CommonOptions& common, const DiffOptions& options,
                          double timeout_s) {
  auto peer = fleet::JoinAsOperator(common, fleet::ExporterTopics());
  if (!peer) return tl::unexpected(peer.error());
  const program::StopSignal stop;
  fleet::TransferWatch watch;
  watch.timeout = ToMilliseconds(timeout_s);
  watch.stop = [] { return program::StopSignal::requested(); };
  auto a = Fetch(*peer, options.a, watch);
  if (!a) return tl::unexpected(a.error());
  auto b = Fetch(*peer, options.b, watch);
  if (!b) return tl::unexpected(b.error());
  junctions::JunctionOptions asked;
  asked.give_up = watch.stop;
  auto found = junctions::CompareAlong(
      {a->segments, a->info.image_width_px}, {b->segments, b->info.image_width_px},
      a->info.camera == b->info.camera, a->info.key.route == b->info.key.route, asked);
  if (watch.stop()) return Fail(ErrorCode::kUnavailable, "interrupted");
  return RouteDiff{std::move(a->info), std::move(b->info), std::move(found)};
}

int Run(const CLI::App& app, const program::CommonOptions& common, const DiffOptions& options,
        double timeout_s) {
  const auto diff = Compare(common, options, timeout_s);
  if (!diff) return program::Complain(app, diff.error());
  std::fputs((options.json ? program::Indented(DiffJson(*diff)) : DiffText(*diff)).c_str(), stdout);
  if (diff->found.parts.empty()) return program::kExitFailure;
  if (options.plot.empty()) return program::kExitOk;
  const auto written = DrawDiff(*diff).and_then(
      [&](const plot::Drawing& drawing) { return drawing.Write(options.plot); });
  return written ? program::kExitOk : program::Complain(app, written.error());
}

}  // namespace

Command AddRouteDiff(CLI::App& routes, const program::CommonOptions& common,
                     const double& timeout_s) {
  auto options = std::make_shared<DiffOptions>();
  CLI::App* app = routes.add_subcommand(
      "diff", "Where the place has changed from one revision, or route, to another");
  app->footer(kRouteDiffExamples);
  app->fallthrough();
  for (const auto& [name, route] : {std::pair("A", &options->a), std::pair("B", &options->b)}) {
    app->add_option(name, *route,
                    "Its name, or its id, of which 7 digits or more will do; '@2' behind it is its "
                    "revision 2, else the one that robots follow")
        ->required()
        ->check(program::RouteRefValidator());
  }
  app->add_option("--plot", options->plot,
                  "Where a picture of it goes (PNG, or SVG by its name): along the path what "
                  "stayed, went and came, and how far the path was moved");
  app->add_flag("--json", options->json, "For programs");
  return {app,
          [app, options, &common, &timeout_s] { return Run(*app, common, *options, timeout_s); }};
}

}  // namespace trailcast::tool
