#include <malloc.h>
#include <spdlog/spdlog.h>

#include <memory>

#include "route_server/check.h"
#include "route_server/server.h"
#include "services/program/command_line.h"
#include "services/program/heartbeat.h"
#include "services/program/open_exchange.h"
#include "services/program/stop_signal.h"
#include "services/store/damaged_store.h"
#include "services/store/open_store.h"
#include "services/store/postgres_url.h"

namespace {

using trailcast::AgentId;
namespace program = trailcast::program;

constexpr const char* kFooter = R"(Examples:
  trailcast-server --store routes.db
  trailcast-server --store routes.db --domain 7 --network-interface wlan0
  trailcast-server --config server.toml
  trailcast-server check --store routes.db            # while no server has it open
  trailcast-server check --repair --store routes.db
  trailcast-server health --heartbeat beat            # of one that runs with that option
  trailcast-server --name server-2 --store postgresql://trailcast@db.site/trailcast

Runs until SIGINT, SIGTERM or SIGHUP. A server killed at any instant comes back with everything
it ever confirmed to a scout. Exit status: 0 stopped by a signal, 1 failed, 2 wrong usage;
of check: 0 the store is whole, or was made whole, 1 it is damaged, or could not be read,
4 it is sound, or was made so, but something that it held is lost.)";

constexpr int kExitIncomplete = 4;  // for check

struct HttpOptions {
  std::string host = "127.0.0.1";
  int port = 0;  // 0 for no page
};

struct StoreOptions {
  std::string location;
  std::string missions;   // if empty, it is beside the location, provided that is a file
  std::string junctions;  // likewise
  std::string history;    // likewise
  std::string photos;     // likewise, a folder
  std::uint64_t photos_mb = 2000;
  bool junctions_auto = false;
  std::uint64_t limit_mb = 0;
  std::uint64_t quota_mb = 0;  // for each scout
  std::uint32_t keep_revisions = 0;
  std::uint32_t keep_days = 0;
  std::uint32_t delete_a_day = trailcast::catalog::RetentionPolicy{}.most_a_day;
  std::string ages;  // see `missions`
};

void AddStoreOptions(CLI::App& app, StoreOptions& options) {
  app.add_option(
         "--store", options.location,
         "SQLite file that holds the routes, created if missing; or the URL of a PostgreSQL "
         "database, postgresql://user@host/database, which several servers may share")
      ->required()
      ->envname("TRAILCAST_STORE");
  app.option_defaults()->group("What it keeps");
  app.add_option(
         "--store-limit-mb", options.limit_mb,
         "How large the file may grow, in megabytes; scouts are told when it is full and keep "
         "what they taught; 0: as large as the disk; not with PostgreSQL")
      ->envname("TRAILCAST_STORE_LIMIT_MB");
  app.add_option("--missions", options.missions,
                 "SQLite file that holds what robots were sent to do, created if missing; default: "
                 "the store's name with '.missions' behind it; with PostgreSQL, each server's own: "
                 "without one, it keeps no missions")
      ->envname("TRAILCAST_MISSIONS");
  app.add_option("--junctions", options.junctions,
                 "SQLite file that holds how routes are joined, created if missing; default: the "
                 "store's name with '.joints' behind it; with PostgreSQL, each server's own: "
                 "without one, it keeps no network of routes")
      ->envname("TRAILCAST_JUNCTIONS");
  app.add_option(
         "--history", options.history,
         "SQLite file that holds what was changed of routes and of how they are joined, and "
         "by whom, created if missing; default: the store's name with '.history' behind it; "
         "with PostgreSQL, each server's own: without one, it keeps no history")
      ->envname("TRAILCAST_HISTORY");
  app.add_option("--photos", options.photos,
                 "Folder that holds the photos that robots took on missions, made if missing; "
                 "default: the store's name with '.photos' behind it; with PostgreSQL, each "
                 "server's own: without one, it keeps no photos, and robots keep theirs")
      ->envname("TRAILCAST_PHOTOS");
  app.add_option("--photos-mb", options.photos_mb,
                 "Megabytes that these may have: the oldest make room")
      ->check(CLI::Range(1, 100'000'000))
      ->envname("TRAILCAST_PHOTOS_MB");
  app.add_flag(
         "--junctions-auto", options.junctions_auto,
         "Make junctions of the places where the server is sure, at 0.9 or more, that routes meet; "
         "without, they are proposed, and 'trailcast network confirm' makes them")
      ->envname("TRAILCAST_JUNCTIONS_AUTO");
  app.add_option("--keep-revisions", options.keep_revisions,
                 "How many complete revisions of a route to keep, the newest, besides the active "
                 "one; older ones are deleted; 0: all")
      ->envname("TRAILCAST_KEEP_REVISIONS");
  app.add_option("--keep-days", options.keep_days,
                 "Delete revisions that are not active so many days after the last of them was "
                 "stored here, by the time that this server has run since; 0: never")
      ->check(CLI::Range(0, 36500))
      ->envname("TRAILCAST_KEEP_DAYS");
  app.add_option("--delete-a-day", options.delete_a_day,
                 "How many revisions go in a day at most by the two before; what is more waits")
      ->check(CLI::Range(1, 1'000'000))
      ->envname("TRAILCAST_DELETE_A_DAY");
  app.add_option("--ages", options.ages,
                 "SQLite file that holds for how long revisions lie here, for --keep-days, created "
                 "if missing; default: the store's name with '.ages' behind it; with PostgreSQL, "
                 "each server's own")
      ->envname("TRAILCAST_AGES");
  app.option_defaults()->group(trailcast::program::kFirstGroup);
}

void AddQuotaOptions(CLI::App& app, trailcast::server::QuotaOptions& options,
                     std::uint64_t& stored_mb) {
  app.option_defaults()->group("Quotas");
  app.add_option("--quota-segments-per-s", options.segments_per_s,
                 "How many segments a second are taken from an agent, or sent to it; the others "
                 "later; 0: as many as there are")
      ->envname("TRAILCAST_QUOTA_SEGMENTS_PER_S");
  app.add_option("--quota-mb", stored_mb,
                 "How much the routes of one scout may take here, in megabytes; its scout is told, "
                 "and keeps what it taught; 0: any amount")
      ->envname("TRAILCAST_QUOTA_MB");
  app.add_option("--quota-routes", options.routes,
                 "How many routes of one scout are kept here, revisions counted; 0: any number")
      ->envname("TRAILCAST_QUOTA_ROUTES");
  app.add_option("--quota-requests-per-s", options.requests_per_s,
                 "How many questions, edits and missions a second are taken from a member; the "
                 "others are answered with an error, or put off; 0: any number")
      ->envname("TRAILCAST_QUOTA_REQUESTS_PER_S");
  app.option_defaults()->group(trailcast::program::kFirstGroup);
}

// The whole parts of a damaged file are served.
trailcast::Result<std::unique_ptr<trailcast::store::RouteStore>> OpenStore(
    const StoreOptions& options) {
  auto store =
      trailcast::store::OpenStore(options.location, {.max_bytes = options.limit_mb * 1'000'000});
  const bool is_file = !trailcast::store::IsPostgresUrl(options.location);
  if (store || !is_file || store.error().code != trailcast::ErrorCode::kCorrupt) return store;
  auto damaged = trailcast::store::OpenDamagedStore(options.location);
  if (!damaged) return store;
  spdlog::error("{}", store.error().message);
  for (const std::string& line : damaged->lost) spdlog::error("lost: {}", line);
  spdlog::error(
      "serving what is whole, read only: scouts keep what they teach; to mend it, stop this server "
      "and run 'trailcast-server check --repair --store {}'",
      options.location);
  return std::move(damaged->whole);
}

// Returns the path of a file of this server's own: `given`, or one beside its routes, or an empty
// path if it has none.
std::string OwnFile(const StoreOptions& options, const std::string& given, const char* ending) {
  const bool beside = given.empty() && !trailcast::store::IsPostgresUrl(options.location);
  return beside ? options.location + ending : given;
}

// Opens such a file. If it cannot be kept, the server says what is lost, and serves routes without
// it.
template <typename Store>
void Keep(const std::string& file, const char* what, trailcast::server::Server& server,
          trailcast::Result<void> (trailcast::server::Server::*keep)(std::unique_ptr<Store>)) {
  if (file.empty()) return;
  const auto kept =
      Store::Open(file).and_then([&](auto store) { return (server.*keep)(std::move(store)); });
  if (!kept) spdlog::error("keeping no {}: {}", what, kept.error().message);
}

void KeepPhotos(const StoreOptions& options, trailcast::server::Server& server) {
  constexpr std::uint64_t kMegabyte = 1'000'000;
  const std::string folder = OwnFile(options, options.photos, ".photos");
  if (folder.empty()) return;
  auto opened = trailcast::photos::PhotoFolder::Open(folder, options.photos_mb * kMegabyte);
  if (opened) {
    server.KeepPhotos(*std::move(opened));
  } else {
    spdlog::error("{}", opened.error().message);
  }
}

// Nothing is deleted whose age is not known.
trailcast::Result<void> Retain(const StoreOptions& options, trailcast::server::Server& server) {
  const trailcast::catalog::RetentionPolicy policy{
      .keep_revisions = options.keep_revisions,
      .keep_for = std::chrono::hours(24) * options.keep_days,
      .most_a_day = options.delete_a_day};
  if (!policy.any()) return {};
  std::string file = OwnFile(options, options.ages, ".ages");
  if (file.empty() && options.keep_days > 0) {
    return trailcast::Fail(trailcast::ErrorCode::kInvalidArgument,
                           "--keep-days with PostgreSQL needs --ages FILE, in which this server "
                           "keeps for how long it has seen revisions lie");
  }
  auto ages = trailcast::store::AgeStore::Open(file.empty() ? ":memory:" : file);
  if (ages) {
    server.Retain(policy, *std::move(ages));
  } else {
    spdlog::error("deleting nothing that is outdated: {}", ages.error().message);
  }
  return {};
}

// Cyclone receives into blocks of 1 MB. The C library would take the first from the system and,
// once that is freed, all others from its heap. These fragment the heap, which then grows by some 9
// kB with each client that comes and goes, for the first thousand. A fixed threshold does not move.
void KeepHeapWhole() {
  constexpr int kHalfAMegabyte = 512 * 1024;
  mallopt(M_MMAP_THRESHOLD, kHalfAMegabyte);  // NOLINT(concurrency-mt-unsafe): the only thread yet
}

int Serve(const CLI::App& app, const program::CommonOptions& common, const StoreOptions& options,
          trailcast::server::QuotaOptions quotas, const HttpOptions& http) {
  KeepHeapWhole();
  program::SetUpLog(common);
  const program::StopSignal stop;
  auto store = OpenStore(options);
  if (!store) return program::Complain(app, store.error());
  const auto network = std::make_shared<trailcast::exchange::NetworkState>();
  auto exchange = program::OpenExchange(
      common, program::WithAgents(trailcast::exchange::ServerTopics()), network);
  if (!exchange) return program::Complain(app, exchange.error());
  auto server = trailcast::server::Server::Open(AgentId(common.name), std::move(*store),
                                                std::move(*exchange));
  if (!server) return program::Complain(app, server.error());
  (*server)->Mind(network);
  using trailcast::server::Server;
  Keep(OwnFile(options, options.missions, ".missions"), "missions", **server,
       &Server::KeepMissions);
  Keep(OwnFile(options, options.junctions, ".joints"), "network of routes", **server,
       &Server::KeepNetwork);
  Keep(OwnFile(options, options.history, ".history"), "history", **server, &Server::KeepHistory);
  KeepPhotos(options, **server);
  if (options.junctions_auto) (*server)->TakeSureJunctions();
  if (auto retains = Retain(options, **server); !retains) {
    return program::Complain(app, retains.error());
  }
  quotas.stored_bytes = options.quota_mb * 1'000'000;
  if (quotas.any()) (*server)->Limit(quotas);
  if (http.port != 0) {
    auto page = trailcast::server::HttpPage::Open(
        http.host, http.port,
        [](const trailcast::Error& error) { spdlog::error("http: {}", error.message); });
    if (!page) return program::Complain(app, page.error());
    (*server)->ShowOn(std::move(*page));
    spdlog::info("health and metrics: http://{}:{}/health and /metrics", http.host, http.port);
  }
  if (auto ran = (*server)->Run([] { return program::StopSignal::requested(); }); !ran) {
    return program::Complain(app, ran.error());
  }
  return program::kExitOk;
}

int CheckStore(const CLI::App& app, const std::string& location, bool repair) {
  using trailcast::server::Condition;
  const auto condition = trailcast::server::Check(location, repair);
  if (!condition) return program::Complain(app, condition.error());
  if (*condition == Condition::kIncomplete) return kExitIncomplete;
  return *condition == Condition::kWhole ? program::kExitOk : program::kExitFailure;
}

int Run(int argc, char** argv) {
  CLI::App app("Keeps the routes of a swarm: stores what scouts teach, serves it to followers.",
               "trailcast-server");
  app.footer(kFooter);
  program::CommonOptions common;
  common.name = "server";
  StoreOptions store;
  program::AddCommonOptions(app, common);
  AddStoreOptions(app, store);
  trailcast::server::QuotaOptions quotas;
  AddQuotaOptions(app, quotas, store.quota_mb);
  HttpOptions http;
  app.add_option("--http-port", http.port,
                 "Serve /health and /metrics (Prometheus) over HTTP on this port; 0: do not")
      ->check(CLI::Range(0, 65535))
      ->envname("TRAILCAST_HTTP_PORT");
  app.add_option("--http-host", http.host,
                 "Address to listen on for that; 0.0.0.0 lets other machines ask")
      ->envname("TRAILCAST_HTTP_HOST");
  bool repair = false;
  CLI::App* check = app.add_subcommand("check", "Read the whole store and tell what is damaged");
  check->fallthrough();
  check->add_flag("--repair", repair,
                  "Make a store of what is whole, and keep the damaged file beside it");
  const CLI::App* health = program::AddHeartbeat(app, common);
  if (const auto ended = program::Parse(app, argc, argv)) return *ended;
  if (health->parsed()) return program::RunHealth(app, common);
  if (check->parsed()) return CheckStore(app, store.location, repair);
  return Serve(app, common, store, quotas, http);
}

}  // namespace

int main(int argc, char** argv) {
  return program::RunMain("trailcast-server", [&] { return Run(argc, argv); });
}
