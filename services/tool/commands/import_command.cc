#include <chrono>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "services/base/time.h"
#include "services/fleet/operator_peer.h"
#include "services/fleet/routes/catalog_client.h"
#include "services/fleet/routes/route_import.h"
#include "services/fleet/routes/route_summary.h"
#include "services/program/json.h"
#include "services/tool/commands/command.h"

namespace trailcast::tool {
namespace {

namespace fs = std::filesystem;
using archive::RouteFile;

struct ImportOptions {
  std::vector<fs::path> files;
  fs::path store;
  bool check = false;
  bool json = false;
  double timeout_s = 10.0;
};

constexpr const char* kImportExamples =
    "Examples:\n"
    "  trailcast import hall.trailcast yard.trailcast   # to a route server\n"
    "  trailcast import hall.trailcast --store robot.db # no network\n"
    "  trailcast import --check *.trailcast             # are they whole? what is in them?\n"
    "Each file is checked before anything of it is sent or stored. A file that is refused does "
    "not\n"
    "keep the others from being imported. Exit status: 0 all are there, 1 some are not, 2 wrong\n"
    "usage.";

// Prints what is in the files. Returns true if all are whole.
bool Check(const CLI::App& app, const ImportOptions& options) {
  bool all = true;
  auto json = program::Json::array();
  for (const fs::path& path : options.files) {
    const auto file = RouteFile::Open(path);
    if (!file) program::Complain(app, file.error());
    all = all && file.has_value();
    if (options.json) {
      json.push_back(fleet::FileJson(path.string(), file));
    } else if (file) {
      fmt::print("{}", fleet::FileText(path.string(), *file));
    }
  }
  if (options.json) fmt::print("{}", program::Indented(json));
  return all;
}

using ImportOne = std::function<Result<fleet::Imported>(const RouteFile&)>;

// Returns true if a server has all of them now. It goes on after a file that is refused, but not
// without a server.
bool ImportAll(const CLI::App& app, const ImportOptions& options, const ImportOne& import_one) {
  bool all = true;
  for (const fs::path& path : options.files) {
    const auto file = RouteFile::Open(path);
    const auto imported =
        file ? import_one(*file) : Result<fleet::Imported>(tl::unexpected(file.error()));
    if (imported) {
      const route::RouteInfo& info = file->info();
      fmt::print("{}: route '{}' revision {} ({} segments, {}) {} {}\n", path.string(), info.name,
                 info.revision.value(), info.segment_count, fleet::LengthText(info),
                 imported->was_there ? "was there already:" : "is there now:", imported->holder);
      std::fflush(stdout);
      continue;
    }
    all = false;
    program::Complain(app, file ? Wrap(imported.error(), path.string()).value() : file.error());
    if (file && imported.error().code == ErrorCode::kUnavailable) break;
  }
  return all;
}

Result<bool> IntoStore(const CLI::App& app, const ImportOptions& options) {
  auto store = store::OpenSqliteStore(options.store);
  if (!store) return tl::unexpected(store.error());
  return ImportAll(app, options, [&](const RouteFile& file) {
    return fleet::ImportIntoStore(file, **store, "route store " + options.store.string());
  });
}

Result<bool> ToServer(const CLI::App& app, const program::CommonOptions& common,
                      const ImportOptions& options) {
  auto peer = fleet::JoinAsOperator(common, fleet::ImporterTopics());
  if (!peer) return tl::unexpected(peer.error());
  fleet::TransferWatch watch;
  watch.timeout = ToMilliseconds(options.timeout_s);
  return ImportAll(app, options, [&](const RouteFile& file) {
    fleet::TransferProgress progress(fmt::format("delivering '{}'", file.info().name),
                                     file.info().bytes);
    watch.progress = [&progress](std::uint64_t done) { progress.Show(done); };
    return fleet::ImportToServer(file, *peer, watch);
  });
}

int Run(const CLI::App& app, const program::CommonOptions& common, const ImportOptions& options) {
  Result<bool> all = options.check            ? Check(app, options)
                     : !options.store.empty() ? IntoStore(app, options)
                                              : ToServer(app, common, options);
  if (!all) return program::Complain(app, all.error());
  return *all ? program::kExitOk : program::kExitFailure;
}

}  // namespace

Command AddImportCommand(CLI::App& parent, const program::CommonOptions& common) {
  auto options = std::make_shared<ImportOptions>();
  CLI::App* app = parent.add_subcommand("import", "Take up routes from files that export wrote");
  app->footer(kImportExamples);
  app->option_defaults()->always_capture_default();
  app->add_option("files", options->files, "The files")->required();
  CLI::Option* store =
      app->add_option("--store", options->store, "Into this store file instead of a route server");
  CLI::Option* check = app->add_flag("--check", options->check,
                                     "Only look whether they are whole, and what is in them");
  check->excludes(store);
  app->add_flag("--json", options->json, "With --check: for programs")->needs(check);
  app->add_option("--timeout", options->timeout_s, "Seconds to wait for a server to go on")
      ->check(CLI::Range(0.1, 3600.0));
  return {app, [app, options, &common] { return Run(*app, common, *options); }};
}

}  // namespace trailcast::tool
