// network.sh measures with this; see network_bench.h.
#include "tests/bench/network/network_bench.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "services/program/command_line.h"
#include "services/store/route_store.h"
#include "tests/bench/million_routes.h"
#include "tests/support/taught_route.h"

namespace trailcast::bench {

double Percentile(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  const auto at = static_cast<std::size_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(at), values.end());
  return values[at];
}

Result<void> MakeStore(const std::filesystem::path& file, std::uint32_t segments, int features) {
  auto store = store::OpenSqliteStore(file);
  if (!store) return tl::unexpected(store.error());
  test::TaughtRoute taught = test::TeachSamples(segments, features);
  taught.info.standing = route::Standing::kActive;
  if (auto put = (*store)->PutRoute(taught.info); !put) return put;
  if (auto put = (*store)->AppendSegments(taught.pieces); !put) return put;
  fmt::print("{} segments, {} bytes\n", segments, taught.info.bytes);
  return {};
}

Result<void> MakeMillion(const std::filesystem::path& file) {
  auto store = store::OpenSqliteStore(file);
  if (!store) return tl::unexpected(store.error());
  return PutMillionRoutes(**store);
}

}  // namespace trailcast::bench

namespace {

int Run(int argc, char** argv) {
  namespace bench = trailcast::bench;
  CLI::App app("Measures the sharing of routes");
  app.require_subcommand(1);

  std::string file;
  std::uint32_t segments = 500;
  int features = 38;
  int samples = 2000;
  int group = 10;
  bench::IngestOptions ingest;
  CLI::App* store = app.add_subcommand("store", "Makes a store with one route");
  store->add_option("file", file)->required();
  store->add_option("--segments", segments);
  store->add_option("--features", features);
  CLI::App* million = app.add_subcommand("million", "Makes a store with a million routes");
  million->add_option("file", file)->required();
  CLI::App* latency = app.add_subcommand("latency", "One segment's way over the loopback");
  latency->add_option("--samples", samples);
  bool secured = false;
  latency->add_flag("--secured", secured, "With DDS Security");
  CLI::App* load = app.add_subcommand("ingest", "Many scouts teach at once");
  load->add_option("--tag", ingest.tag)->required();
  load->add_option("--scouts", ingest.scouts);
  load->add_option("--participants", ingest.participants);
  load->add_option("--rate", ingest.segments_per_s);
  load->add_option("--duration", ingest.duration_s);
  load->add_option("--route-segments", ingest.segments_a_route);
  bench::LightAgentOptions light;
  CLI::App* agent = app.add_subcommand("light-agent", "Agents without robots, until a signal");
  agent->add_option("--name", light.name)->required();
  agent->add_option("--route", light.route);
  agent->add_option("--discovery", light.discovery)->check(CLI::IsMember({"star", "mesh"}));
  agent->add_option("--count", light.count);
  agent->add_flag("--follow", light.follow);
  agent->add_option("--network-interface", light.network_interface);
  agent->add_option("--agents", light.agents);
  CLI::App* commits = app.add_subcommand("commits", "Bare SQLite group commits");
  commits->add_option("folder", file)->required();
  commits->add_option("--group", group);
  CLI::App* write = app.add_subcommand("write-transient-local", "Plain Cyclone, the writer");
  write->add_option("--samples", samples);
  CLI::App* read = app.add_subcommand("read-transient-local", "Plain Cyclone, the late reader");
  read->add_option("--samples", samples);
  std::string robot;
  CLI::App* stop = app.add_subcommand("stop", "A robot is told to pause, again and again");
  stop->add_option("robot", robot)->required();
  stop->add_option("--samples", samples);
  bench::LinkOptions line;
  int delay_ms = 0;
  CLI::App* link = app.add_subcommand("link", "A line between two networks, until a signal");
  link->add_option("from", line.from_pid, "A process in the one")->required();
  link->add_option("to", line.to_pid, "A process in the other")->required();
  link->add_option("--delay", delay_ms, "ms, each way")->check(CLI::Range(0, 10'000));
  link->add_option("--loss", line.loss, "Share, each way")->check(CLI::Range(0.0, 1.0));
  bench::MeetingOptions meeting;
  CLI::App* meet = app.add_subcommand("meet", "A server is met, and asked again and again");
  meet->add_option("--server-address", meeting.server_address);
  meet->add_option("--network-interface", meeting.network_interface);
  meet->add_option("--queries", meeting.queries)->check(CLI::Range(1, 10'000));
  meet->add_option("--patience", meeting.patience_s);
  std::string picture;
  CLI::App* plot = app.add_subcommand("plot-fleet", "Draws what network.sh sizes has measured");
  plot->add_option("csv", file)->required();
  plot->add_option("picture", picture)->required();
  CLI11_PARSE(app, argc, argv);

  trailcast::Result<void> done;
  if (store->parsed()) done = bench::MakeStore(file, segments, features);
  if (million->parsed()) done = bench::MakeMillion(file);
  if (latency->parsed()) done = bench::MeasureLatency(samples, secured);
  if (load->parsed()) done = bench::MeasureIngest(ingest);
  if (agent->parsed()) done = bench::RunLightAgents(light);
  if (commits->parsed()) done = bench::MeasureCommits(file, group);
  if (write->parsed()) done = bench::WriteTransientLocal(samples);
  if (read->parsed()) done = bench::ReadTransientLocal(samples);
  if (stop->parsed()) done = bench::MeasureStops(robot, samples);
  line.delay = std::chrono::milliseconds(delay_ms);
  if (link->parsed()) done = bench::RunLink(line);
  if (meet->parsed()) done = bench::MeasureMeeting(meeting);
  if (plot->parsed()) done = bench::PlotFleet(file, picture);
  if (done) return 0;
  fmt::print(stderr, "{}\n", done.error().message);
  return 1;
}

}  // namespace

int main(int argc, char** argv) {
  return trailcast::program::RunMain("network_bench", [&] { return Run(argc, argv); });
}
