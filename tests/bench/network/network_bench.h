#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "services/base/result.h"

namespace trailcast::bench {

// These are the subcommands of network_bench, with which network.sh measures.

// Makes a store as a server has it, with one complete route, "hall", of segments that decode.
[[nodiscard]] Result<void> MakeStore(const std::filesystem::path& file, std::uint32_t segments,
                                     int features);

// Makes a store with a million routes without segments.
[[nodiscard]] Result<void> MakeMillion(const std::filesystem::path& file);

// Measures from Publish on one exchange to Take on another, 4 KiB on the loopback interface, and
// how long after both were opened the first sample came. `secured` uses keys of a fleet of its own.
[[nodiscard]] Result<void> MeasureLatency(int samples, bool secured);

struct IngestOptions {
  std::uint32_t scouts = 200;
  std::uint32_t participants = 4;
  double segments_per_s = 1.0;  // for each scout
  double duration_s = 20.0;
  std::uint32_t segments_a_route = 300;  // then the scout teaches another one
  std::string tag;
};
// Plays many scouts to a running server, and prints how long their acknowledgements take.
[[nodiscard]] Result<void> MeasureIngest(const IngestOptions& options);

struct LightAgentOptions {
  std::string name;   // of the first; others have a number behind it
  std::string route;  // none is fetched if empty
  std::string network_interface = "eth0";
  std::string discovery = "star";
  std::size_t agents = 100;  // of the whole fleet, on all hosts
  // So many of them are in this process, each with a participant and the threads and sockets of
  // one.
  std::size_t count = 1;
  bool follow = false;  // reports a place on a route, and listens to its neighbours there
};
// Each joins, finds the route in the catalog, fetches it, and stays until a signal. It prints when,
// in seconds since the machine started: joined, met (a server's status), heard-all (a status of
// every other agent and the server), answered, fetched. At the end, if it follows, it prints how
// often each heard of its neighbours, and how old that was.
[[nodiscard]] Result<void> RunLightAgents(const LightAgentOptions& options);

// Draws the columns of `csv` against its "agents".
[[nodiscard]] Result<void> PlotFleet(const std::filesystem::path& csv,
                                     const std::filesystem::path& picture);

// Pauses a robot that follows a route and resumes it, so many times. Prints when it was told to (ms
// since 1970) and after how many ms its answer was there.
[[nodiscard]] Result<void> MeasureStops(const std::string& robot, int samples);

struct LinkOptions {
  int from_pid = 0;  // processes in the two networks
  int to_pid = 0;
  std::chrono::milliseconds delay{0};  // in each direction
  double loss = 0.0;                   // share of the packets, in each direction
};
// Makes a line between two networks, the interface "wan" in both, until a signal. It prints
// "ready".
[[nodiscard]] Result<void> RunLink(const LinkOptions& options);

struct MeetingOptions {
  std::string server_address;  // by multicast if empty
  std::string network_interface = "eth0";
  int queries = 50;
  double patience_s = 120.0;
};
// Joins a star, and asks the catalog for one route repeatedly. Prints after how many ms the server
// was heard, and the median and the 99th percentile of ms until an answer.
[[nodiscard]] Result<void> MeasureMeeting(const MeetingOptions& options);

// Measures group commits of pieces by SQLite's own interface, without this project's code.
[[nodiscard]] Result<void> MeasureCommits(const std::filesystem::path& folder, int group);

// Measures Cyclone alone, with its own defaults: 4 KiB samples from a transient-local, keep-all
// writer to a reader that comes late.
[[nodiscard]] Result<void> WriteTransientLocal(int samples);
[[nodiscard]] Result<void> ReadTransientLocal(int samples);

[[nodiscard]] double Percentile(std::vector<double> values, double share);

}  // namespace trailcast::bench
