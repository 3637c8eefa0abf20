#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "services/base/result.h"

namespace trailcast::bench {

// What network.sh measures with, each a subcommand of network_bench.

// A store as a server has it, with one complete route, "hall", of segments that decode.
[[nodiscard]] Result<void> MakeStore(const std::filesystem::path& file, std::uint32_t segments,
                                     int features);

// A store with a million routes without segments.
[[nodiscard]] Result<void> MakeMillion(const std::filesystem::path& file);

// From Publish on one exchange to Take on another, 4 KiB on the loopback interface; and how long
// after both were opened the first sample came. `secured`: with keys of a fleet of its own.
[[nodiscard]] Result<void> MeasureLatency(int samples, bool secured);

struct IngestOptions {
  std::uint32_t scouts = 200;
  std::uint32_t participants = 4;
  double segments_per_s = 1.0;  // each scout
  double duration_s = 20.0;
  std::uint32_t segments_a_route = 300;  // then the scout teaches another
  std::string tag;
};
// Plays many scouts to a running server, and tells how long their receipts take.
[[nodiscard]] Result<void> MeasureIngest(const IngestOptions& options);

struct LightAgentOptions {
  std::string name;   // of the first; others have a number behind
  std::string route;  // empty: none is fetched
  std::string network_interface = "eth0";
  std::string discovery = "star";
  std::size_t agents = 100;  // all there are, on all hosts
  // Of these in this process, a participant each, with the threads and sockets of one.
  std::size_t count = 1;
  bool follow = false;  // tells of a place on a route, and listens to its neighbours there
};
// Each joins, finds the route in the catalog, fetches it, and stays until a signal. Says on stdout
// when, in seconds since the machine started: joined, met (a server's status), heard-all (a status
// of every other agent and the server), answered, fetched. At the end, if it follows: how often
// each was told of its neighbours, and how old what was told was.
[[nodiscard]] Result<void> RunLightAgents(const LightAgentOptions& options);

// The columns of `csv` against its "agents".
[[nodiscard]] Result<void> PlotFleet(const std::filesystem::path& csv,
                                     const std::filesystem::path& picture);

// Has a robot that follows a route pause, and go on, so many times: prints when it was told to (ms
// since 1970) and after how many ms its answer was there.
[[nodiscard]] Result<void> MeasureStops(const std::string& robot, int samples);

struct LinkOptions {
  int from_pid = 0;  // processes in the two networks
  int to_pid = 0;
  std::chrono::milliseconds delay{0};  // each way
  double loss = 0.0;                   // share of the packets, each way
};
// A line between two networks, the interface "wan" in both, until a signal. Says "ready".
[[nodiscard]] Result<void> RunLink(const LinkOptions& options);

struct MeetingOptions {
  std::string server_address;  // empty: by multicast
  std::string network_interface = "eth0";
  int queries = 50;
  double patience_s = 120.0;
};
// Joins a star, and asks the catalog for one route again and again: prints after how many ms the
// server was heard, and the median and the 99th percentile of ms until an answer.
[[nodiscard]] Result<void> MeasureMeeting(const MeetingOptions& options);

// Group commits of pieces by SQLite's own interface, nothing of ours around it.
[[nodiscard]] Result<void> MeasureCommits(const std::filesystem::path& folder, int group);

// Cyclone alone, with its own defaults: 4 KiB samples from a transient-local, keep-all writer to a
// reader that comes late.
[[nodiscard]] Result<void> WriteTransientLocal(int samples);
[[nodiscard]] Result<void> ReadTransientLocal(int samples);

[[nodiscard]] double Percentile(std::vector<double> values, double share);

}  // namespace trailcast::bench
