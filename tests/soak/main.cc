// Teach, follow, retire for hours while things go wrong: ./run soak [MINUTES].
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <fstream>

#include "services/program/command_line.h"
#include "services/program/stop_signal.h"
#include "tests/soak/member.h"
#include "tests/soak/soak.h"
#include "tests/support/network_lab.h"
#include "tests/support/temp_dir.h"

namespace {

namespace program = trailcast::program;
namespace soak = trailcast::soak;

constexpr const char* kFooter =
    R"(A scout teaches a route, two followers follow it meanwhile, an operator retires and deletes the
routes before, again and again, each program at a host of its own of a network staged on this
machine. Programs are killed and paused, hosts cut off or given other addresses, packets lost, clocks
stepped by forty days, the server's disk is filled, in an order drawn by the seed. At the end: is everything that was receipted there, byte for byte; did the
server grow; how long did the fleet need to find itself again.

Needs root, for the network, iptables and libfaketime. Exit status: 0 all is well, 1 something failed.)";

int Run(int argc, char** argv) {
  CLI::App app("Runs a small fleet for hours while things go wrong", "soak");
  app.footer(kFooter);
  app.option_defaults()->always_capture_default();
  soak::SoakOptions options;
  int minutes = 120;
  std::string folder;
  app.add_option("MINUTES", minutes, "How long")->check(CLI::Range(1, 100'000));
  app.add_option("--seed", options.seed, "Draws the faults, and the robots' errors");
  app.add_option("--folder", folder, "Keeps logs and stores here; default: a temporary one");
  app.add_option("--csv", options.csv, "Writes the server's memory, threads and descriptors here");
  if (const auto ended = program::Parse(app, argc, argv)) return *ended;
  if (const std::string obstacle = trailcast::test::NetworkLab::Obstacle(); !obstacle.empty()) {
    return program::Complain(app, {trailcast::ErrorCode::kUnavailable, obstacle});
  }
  if (!std::filesystem::exists(soak::kClockLibrary)) {
    return program::Complain(
        app, {trailcast::ErrorCode::kUnavailable,
              fmt::format("no {}: install the package libfaketime", soak::kClockLibrary)});
  }
  options.length = std::chrono::minutes(minutes);
  const trailcast::test::TempDir temporary;
  options.folder = folder.empty() ? temporary.path() : std::filesystem::absolute(folder);
  const program::StopSignal stop;
  soak::Soak run(options);
  const soak::Report report = run.Run([] { return program::StopSignal::requested(); });
  fmt::print("{}", report.Text());
  return report.failures.empty() ? program::kExitOk : program::kExitFailure;
}

}  // namespace

int main(int argc, char** argv) {
  return program::RunMain("soak", [&] { return Run(argc, argv); });
}
