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

// What every process of ours is told: who it is and over which network it speaks.
struct CommonOptions {
  std::string name;  // unique in the fleet
  int domain = 0;    // DDS domain
  std::string dds_tag;
  std::string network_interface;
  std::string discovery = "auto";             // "auto", "star" or "mesh"
  std::vector<std::string> server_addresses;  // of route servers, where multicast does not lead
  std::string security;   // folder with this member's keys; empty: DDS without security
  std::string heartbeat;  // file; empty: none, as with programs that do not offer one
  std::string log_level = "info";
  std::string log_format = "text";
};

// The version of all programs, as "0.2.0": that of the CMake project.
[[nodiscard]] const char* Version();

// The group of the options that `--help` explains; it names those of other groups, which
// `--help-all` explains as well. Options that are put into no group are of this one.
inline constexpr const char* kFirstGroup = "Options";

// --version, --config, --name and the options of the network and the log, each with its
// environment variable. A value on the command line wins over the file, the file over the
// environment. With --security and no --name, the name is the one in the keys.
void AddCommonOptions(CLI::App& app, CommonOptions& options);

// Parses. Nothing: go on. Otherwise the process shall end with that exit status: help or version
// were shown, or what is wrong was said on stderr (kExitUsage).
[[nodiscard]] std::optional<int> Parse(CLI::App& app, int argc, char** argv);

// Accepts names that IsValidName accepts.
[[nodiscard]] CLI::Validator NameValidator();
// What ParseRouteRef takes.
[[nodiscard]] CLI::Validator RouteRefValidator();
// Of a route said as "hall@2" and a --revision given besides (0: none) the revision that is meant.
// kInvalidArgument when they differ.
[[nodiscard]] Result<route::RouteRef> WithRevision(const std::string& route,
                                                   std::uint32_t revision);
// Whole numbers from 1.
[[nodiscard]] CLI::Validator RevisionValidator();

// spdlog's default logger to stderr, one line an event (log.cc).
void SetUpLog(const CommonOptions& options);

// Runs a program's `body` and returns its exit status; an exception that gets this far is told on
// stderr and fails the program.
template <typename Body>
int RunMain(const char* program, const Body& body) {
  try {
    return body();
  } catch (const std::exception& exception) {
    std::fprintf(stderr, "%s: %s\n", program, exception.what());
    return kExitFailure;
  }
}

// "trailcast-agent: cannot ..." on stderr; returns kExitFailure.
int Complain(const CLI::App& app, const Error& error);

}  // namespace trailcast::program
