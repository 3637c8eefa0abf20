#include <spdlog/spdlog.h>

#include <chrono>
#include <thread>

#include "services/console/desk.h"
#include "services/console/web.h"
#include "services/fleet/operator_peer.h"
#include "services/program/command_line.h"
#include "services/program/stop_signal.h"

namespace {

namespace program = trailcast::program;
namespace console = trailcast::console;

constexpr const char* kFooter = R"(Example:
  trailcast-console                # then http://localhost:8080 in this machine's browser
  ssh -L 8080:localhost:8080 desk  # or, on another one, to where it runs

Whoever reaches the port commands the robots: there are no users and passwords. It therefore listens
on this machine alone. Other machines come by ssh, or by a reverse proxy that asks who they are:
then --allowed-host is the name under which it is reached.
The Stop button is no emergency stop: a robot that is out of reach drives on.
Exit status: 0 stopped by a signal, 1 failed, 2 wrong usage.)";

struct WebOptions {
  std::string host = "127.0.0.1";
  int port = 8080;
  std::vector<std::string> names;
};

CLI::Validator LoopbackValidator() {
  return {[](const std::string& host) -> std::string {
            if (host == "127.0.0.1" || host == "::1" || host == "localhost") return "";
            return "'" + host +
                   "' lets others in, and there are no users and passwords yet: listen on "
                   "127.0.0.1, and put a reverse proxy that asks who they are before it (with "
                   "--allowed-host NAME)";
          },
          "LOOPBACK"};
}

int Serve(const CLI::App& app, const program::CommonOptions& common, const WebOptions& options) {
  program::SetUpLog(common);
  const program::StopSignal stop;
  auto peer = trailcast::fleet::JoinAsOperator(common, console::ConsoleTopics());
  if (!peer) return program::Complain(app, peer.error());
  console::Desk desk(peer->self, std::move(peer->exchange));
  std::set<std::string> names;
  for (const std::string& name : options.names) names.insert(trailcast::http::Lower(name));
  const auto web = console::Web::Open(desk, options.host, options.port, std::move(names));
  if (!web) return program::Complain(app, web.error());
  spdlog::info("console: http://localhost:{}", (*web)->port());
  while (!program::StopSignal::requested()) {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  desk.Close();
  return program::kExitOk;
}

int Run(int argc, char** argv) {
  CLI::App app("The fleet in a browser: see each robot, send it along a route, have it stand.",
               "trailcast-console");
  app.footer(kFooter);
  program::CommonOptions common;
  common.name = "console";
  common.discovery = "mesh";  // in a star it would not hear what robots say of themselves
  program::AddCommonOptions(app, common);
  WebOptions options;
  app.add_option("--http-host", options.host, "Address of this machine to listen on")
      ->check(LoopbackValidator())
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
  if (const auto ended = program::Parse(app, argc, argv)) return *ended;
  return Serve(app, common, options);
}

}  // namespace

int main(int argc, char** argv) {
  return program::RunMain("trailcast-console", [&] { return Run(argc, argv); });
}
