#include <spdlog/spdlog.h>

#include <atomic>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <thread>

#include "services/console/alert_file.h"
#include "services/console/atlas.h"
#include "services/console/desk.h"
#include "services/console/runs.h"
#include "services/console/site.h"
#include "services/console/users_command.h"
#include "services/console/web.h"
#include "services/fleet/operator_peer.h"
#include "services/fleet/routes/route_export.h"
#include "services/program/command_line.h"
#include "services/program/json.h"
#include "services/program/open_exchange.h"
#include "services/program/stop_signal.h"
#include "services/webhooks/courier.h"

namespace {

namespace program = trailcast::program;
namespace console = trailcast::console;
namespace webhooks = trailcast::webhooks;

constexpr const char* kFooter = R"(Examples:
  trailcast-console                # then http://localhost:8080 in this machine's browser
  ssh -L 8080:localhost:8080 desk  # or, on another one, to where it runs
  trailcast-console users add anna --role operate   # and for others to log in from elsewhere:
  trailcast-console --http-host 0.0.0.0 --users console-users --tls-certificate tls.pem --tls-key tls.key

Without --users, whoever reaches the port commands the robots: it then listens on this machine alone.
The Stop button is no emergency stop: a robot that is out of reach drives on.
Exit status: 0 stopped by a signal, 1 failed, 2 wrong usage.)";

struct WebOptions {
  std::string host = "127.0.0.1";
  int port = 8080;
  std::vector<std::string> names;
  std::string users;
  std::string tls_certificate;
  std::string tls_key;
  bool behind_proxy = false;
  std::filesystem::path site;
  std::filesystem::path logs;
  std::filesystem::path alerts;
  std::filesystem::path webhooks;
};

bool IsLoopback(const std::string& host) {
  return host == "127.0.0.1" || host == "::1" || host == "localhost";
}

// Returns what is missing before others may log in. It is empty if nothing is.
std::string Missing(const WebOptions& options) {
  if (options.tls_certificate.empty() != options.tls_key.empty()) {
    return "--tls-certificate and --tls-key go together";
  }
  const bool encrypted = !options.tls_key.empty() || options.behind_proxy;
  if (options.behind_proxy && options.users.empty()) {
    return "--behind-proxy lets others in: --users FILE says who ('trailcast-console users add "
           "--help')";
  }
  if (IsLoopback(options.host)) return "";
  if (options.users.empty()) {
    return "--http-host " + options.host +
           " lets others in: --users FILE says who ('trailcast-console users add --help')";
  }
  if (encrypted) return "";
  return "--http-host " + options.host +
         " sends passwords through the network: give --tls-certificate and --tls-key, or, where a "
         "reverse proxy speaks TLS, --behind-proxy. A certificate for tries, which browsers warn "
         "of: openssl req -x509 -newkey ec -pkeyopt ec_paramgen_curve:P-256 -nodes -days 365 -subj "
         "/CN=$HOSTNAME -addext subjectAltName=DNS:$HOSTNAME -keyout tls.key -out tls.pem";
}

trailcast::Result<console::Entry> OpenEntry(const WebOptions& options) {
  console::Entry entry;
  entry.behind_proxy = options.behind_proxy;
  if (!options.tls_key.empty()) {
    auto tls = trailcast::http::Tls::Load(options.tls_certificate, options.tls_key);
    if (!tls) return tl::unexpected(tls.error());
    entry.tls = *std::move(tls);
  }
  if (options.users.empty()) return entry;
  auto guard = trailcast::users::Guard::Open(options.users, [](const trailcast::Error& error) {
    spdlog::error("console: {}; the users are those from before", error.message);
  });
  if (!guard) {
    return Wrap(guard.error(), "--users ('trailcast-console users add NAME --role ROLE --users " +
                                   options.users + "' adds one)");
  }
  entry.guard = *std::move(guard);
  return entry;
}

// Returns null if nobody is to be told.
trailcast::Result<std::unique_ptr<webhooks::Courier>> OpenCourier(
    const std::filesystem::path& file) {
  if (file.empty()) return nullptr;
  auto hooks = webhooks::LoadHooks(file);
  if (!hooks) return tl::unexpected(hooks.error());
  const std::filesystem::path waiting = file.string() + ".waiting";
  return webhooks::Courier::Open(*std::move(hooks), waiting, [](const std::string& line) {
    spdlog::warn("console: {}", line);
  });
}

int Serve(const CLI::App& app, const program::CommonOptions& common, const WebOptions& options) {
  if (const std::string missing = Missing(options); !missing.empty()) {
    std::fprintf(stderr, "trailcast-console: %s\n", missing.c_str());
    return program::kExitUsage;
  }
  program::SetUpLog(common);
  auto entry = OpenEntry(options);
  if (!entry) return program::Complain(app, entry.error());
  const program::StopSignal stop;
  const bool commands = program::KeysAllow(common, console::ConsoleTopics());
  if (!commands) {
    entry->only_looks = "this console has the keys of '" + common.name +
                        "', which may look, and tell robots nothing";
    spdlog::info("console: {}", entry->only_looks);
  }
  auto peer = trailcast::fleet::JoinAsOperator(
      common, commands ? console::ConsoleTopics() : console::LookingTopics());
  if (!peer) return program::Complain(app, peer.error());
  std::unique_ptr<console::AlertFile> alerts;
  console::Desk::Options desk_options;
  if (!options.alerts.empty()) {
    auto opened = console::AlertFile::Open(options.alerts);
    if (!opened) return program::Complain(app, Wrap(opened.error(), "--alerts").value());
    alerts = *std::move(opened);
    desk_options.alerts = alerts->alerts();
    desk_options.keep_alerts = [&alerts](std::string text) { alerts->Keep(std::move(text)); };
  }
  auto courier = OpenCourier(options.webhooks);
  if (!courier) return program::Complain(app, Wrap(courier.error(), "--webhooks").value());
  if (*courier) {
    desk_options.look = [&](program::Json all_alerts, program::Json missions) {
      (*courier)->Look(std::move(all_alerts), std::move(missions));
    };
    desk_options.measure = [&](trailcast::http::MetricsText& text) { (*courier)->Measure(text); };
  }
  console::Desk desk(peer->self, std::move(peer->exchange), std::move(desk_options));
  console::Atlas atlas([&] {
    return trailcast::fleet::JoinAsOperator(common, trailcast::fleet::ExporterTopics(), 1);
  });
  std::unique_ptr<console::Site> site;
  if (!options.site.empty()) {
    auto opened = console::Site::Open(options.site);
    if (!opened) return program::Complain(app, opened.error());
    site = *std::move(opened);
  }
  console::Runs runs(options.logs);
  std::set<std::string> names;
  for (const std::string& name : options.names) names.insert(trailcast::http::Lower(name));
  const char* scheme = entry->tls ? "https" : "http";
  std::atomic<int> couriers{0};  // each has a name of its own
  const auto web = console::Web::Open(
      desk, atlas, site.get(), options.host, options.port, std::move(names), *std::move(entry),
      [&](const trailcast::exchange::TopicUse& use) {
        return trailcast::fleet::JoinAsOperator(common, use, 2 + couriers++ % 98);
      },
      &runs);
  if (!web) return program::Complain(app, web.error());
  spdlog::info("console: {}://{}:{}", scheme, IsLoopback(options.host) ? "localhost" : options.host,
               (*web)->port());
  while (!program::StopSignal::requested() && !desk.closed()) {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  desk.Close();
  atlas.Close();
  runs.Close();
  if (const auto failed = desk.failed()) return program::Complain(app, *failed);
  return program::kExitOk;
}

int Run(int argc, char** argv) {
  CLI::App app("The fleet in a browser: see each robot, send it along a route, have it stand.",
               "trailcast-console");
  app.footer(kFooter);
  program::CommonOptions common;
  common.name = "console";
  common.discovery = "mesh";  // in a star it would not hear robots' statuses
  program::AddCommonOptions(app, common);
  WebOptions options;
  app.add_option("--http-host", options.host, "Address of this machine to listen on")
      ->envname("TRAILCAST_HTTP_HOST");
  app.add_option("--http-port", options.port, "Port of the page; 0: any that is free")
      ->check(CLI::Range(0, 65535))
      ->envname("TRAILCAST_HTTP_PORT");
  app.add_option(
         "--allowed-host", options.names,
         "Another name under which browsers reach it, through a reverse proxy; may be given "
         "several times")
      ->take_all()
      ->allow_extra_args(false)
      ->envname("TRAILCAST_ALLOWED_HOST");
  app.add_option("--users", options.users,
                 "File of the users that may log in, as 'trailcast-console users' writes it; "
                 "without it, whoever reaches the port may all")
      ->envname("TRAILCAST_USERS");
  app.add_option("--tls-certificate", options.tls_certificate,
                 "PEM file: serves https alone, with this certificate")
      ->envname("TRAILCAST_TLS_CERTIFICATE");
  app.add_option("--tls-key", options.tls_key, "PEM file: the certificate's key")
      ->envname("TRAILCAST_TLS_KEY");
  app.add_flag("--behind-proxy", options.behind_proxy,
               "Only a reverse proxy reaches the port, which speaks TLS to browsers and says in "
               "X-Forwarded-For where they are")
      ->envname("TRAILCAST_BEHIND_PROXY");
  app.add_option(
         "--site", options.site,
         "Folder with the site's floor plan (plan.png or plan.jpg, and site.json) and where "
         "routes lie upon it, which people say on the page and is kept there")
      ->envname("TRAILCAST_SITE");
  app.add_option("--logs", options.logs,
                 "Folder, and folders in it, where the logs of robots' runs lie ('trailcast-agent "
                 "serve --logs'), as they are mounted or copied there; opened in the history")
      ->check(CLI::ExistingDirectory)
      ->envname("TRAILCAST_LOGS");
  app.add_option("--alerts", options.alerts,
                 "File in which alerts, and who has acknowledged them, outlive the console; made "
                 "if missing")
      ->envname("TRAILCAST_ALERTS");
  app.add_option("--webhooks", options.webhooks,
                 "File of the URLs that are told of alerts and missions, in JSON: [{\"url\": "
                 "\"https://...\", \"secret\": \"...\", \"events\": [\"alert\", "
                 "\"mission.failed\"]}]; what waits is kept beside it, in FILE.waiting")
      ->check(CLI::ExistingFile)
      ->envname("TRAILCAST_WEBHOOKS");
  const console::UsersCommand users(app);
  if (const auto ended = program::Parse(app, argc, argv)) return *ended;
  return users.asked_for() ? users.Run() : Serve(app, common, options);
}

}  // namespace

int main(int argc, char** argv) {
  return program::RunMain("trailcast-console", [&] { return Run(argc, argv); });
}
