// This measures what a console costs, and how smooth its pages are, beside a fleet that is only
// played. console.sh runs it.
#include "tests/bench/console_bench.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>

namespace bench = trailcast::bench;

int main(int argc, char** argv) {
  CLI::App app("What a console costs with a large fleet", "console_bench");
  app.require_subcommand(1);

  std::string file;
  std::uint32_t routes = 5000;
  std::uint32_t followed = 100;
  CLI::App* store = app.add_subcommand("store", "Makes a route server's store");
  store->add_option("file", file)->required();
  store->add_option("--routes", routes);
  store->add_option("--robots", followed);

  bench::PlayedFleetOptions fleet;
  CLI::App* play = app.add_subcommand("play", "Robots on their ways, until a signal");
  play->add_option("--robots", fleet.robots)->check(CLI::Range(1, 1000));
  play->add_option("--network-interface", fleet.network_interface);
  play->add_flag("--still", fleet.still, "They tell the same again and again");

  bench::ConsoleOptions console;
  CLI::App* look = app.add_subcommand("look", "Looks at that fleet");
  look->add_option("programs", console.programs, "Folder of the programs")->required();
  look->add_option("folder", console.folder, "To work in")->required();
  look->add_option("--server", console.server, "The route server's process")->required();
  look->add_option("--network-interface", console.network_interface);
  look->add_option("--robots", console.robots);
  look->add_option("--routes", console.routes);
  look->add_option("--seconds", console.seconds, "For each figure");
  look->add_option("--day", console.day, "Changes that a page is told");
  CLI11_PARSE(app, argc, argv);

  trailcast::Result<void> done;
  if (store->parsed()) done = bench::MakeConsoleStore(file, routes, followed);
  if (play->parsed()) done = bench::PlayFleet(fleet);
  if (look->parsed()) done = bench::MeasureConsole(console);
  if (done) return 0;
  fmt::print(stderr, "console_bench: {}\n", done.error().message);
  return 1;
}
