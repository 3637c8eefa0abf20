#pragma once

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <optional>
#include <string>
#include <vector>

#include "services/base/result.h"
#include "services/route/route_ref.h"

namespace trailcast::program {

inline constexpr int kExitOk = 0;
inline constexpr int kExitFailure = 1;
inline constexpr int kExitUsage = 2;
inline constexpr int kExitNotArrived = 3;

// The options of every program: its name, and the network that it uses.
struct CommonOptions {
  std::string name;  // unique in the fleet
  int domain = 0;    // DDS domain
  std::string dds_tag;
  std::string network_interface;
  std::string discovery = "auto";             // "auto", "star" or "mesh"
  std::vector<std::string> server_addresses;  // of route servers, for networks without multicast
  std::string security;   // folder with this member's keys; empty for DDS without security
  std::string heartbeat;  // file; empty for none, as with programs that do not offer one
  std::string log_level = "info";
  std::string log_format = "text";
};

// Returns the version of all programs, that of the CMake project: "0.2.0".
[[nodiscard]] const char* Version();

// The group of the options that `--help` explains. It names the options of other groups, which
// `--help-all` explains as well. Options without a group belong to it.
inline constexpr const char* kFirstGroup = "Options";

// Adds --version, --config, --name and the options of the network and the log, each with its
// environment variable. The command line overrides the file, and the file overrides the
// environment. With --security and no --name, the name is the one in the keys.
void AddCommonOptions(CLI::App& app, CommonOptions& options);

// Parses the command line. If it returns an exit status, the process must end with that: help or
// version were shown, or an error was printed on stderr (kExitUsage).
[[nodiscard]] std::optional<int> Parse(CLI::App& app, int argc, char** argv);

// Accepts the names that IsValidName accepts.
[[nodiscard]] CLI::Validator NameValidator();
// Accepts what ParseRouteRef takes.
[[nodiscard]] CLI::Validator RouteRefValidator();
// Combines a route given as "hall@2" with a --revision (0 for none). kInvalidArgument means that
// they differ.
[[nodiscard]] Result<route::RouteRef> WithRevision(const std::string& route,
                                                   std::uint32_t revision);
// Accepts whole numbers from 1.
[[nodiscard]] CLI::Validator RevisionValidator();

// Sets spdlog's default logger to stderr, with one line for each event (log.cc).
void SetUpLog(const CommonOptions& options);

// Runs a program's `body` and returns its exit status. An exception that gets this far is printed
// on stderr and fails the program.
template <typename Body>
int RunMain(const char* program, const Body& body) {
  try {
    return body();
  } catch (const std::exception& exception) {
    std::fprintf(stderr, "%s: %s\n", program, exception.what());
    return kExitFailure;
  }
}

// Prints "trailcast-agent: cannot ..." on stderr and returns kExitFailure.
int Complain(const CLI::App& app, const Error& error);

}  // namespace trailcast::program
