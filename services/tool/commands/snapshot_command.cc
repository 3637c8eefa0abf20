// This is `trailcast snapshot`.
#include <chrono>
#include <cstdio>
#include <fstream>
#include <memory>
#include <string>

#include "services/base/time.h"
#include "services/fleet/draw.h"
#include "services/fleet/operator_peer.h"
#include "services/program/output_file.h"
#include "services/tool/commands/command.h"

namespace trailcast::tool {
namespace {

using std::chrono::steady_clock;

struct SnapshotOptions {
  std::string robot;
  std::string out = "seen.jpg";
  double timeout_s = 5.0;
};

constexpr const char* kSnapshotExamples =
    "Example:\n"
    "  trailcast snapshot robot2 -o seen.jpg    # and what is drawn on it, in words\n"
    "Robots show what they see while 'serve', or 'replay' or 'teach' with --server, runs; no "
    "server "
    "passes it\n"
    "on, so it is asked for in a mesh.";

Result<exchange::Snapshot> Ask(const fleet::OperatorPeer& peer, const SnapshotOptions& options) {
  // The exchange asks for a second between requests.
  constexpr std::chrono::seconds kAskAgain{1};
  constexpr std::chrono::milliseconds kTakeWait{50};
  const exchange::SnapshotRequest request{
      .agent = AgentId(options.robot), .client = peer.self, .request = fleet::DrawNumber()};
  const auto deadline = steady_clock::now() + ToMilliseconds(options.timeout_s);
  auto ask_at = steady_clock::now();
  while (steady_clock::now() < deadline) {
    if (steady_clock::now() >= ask_at) {
      // A request that could not be handed over is repeated.
      (void)peer.exchange->Publish(request);
      ask_at = steady_clock::now() + kAskAgain;
    }
    for (exchange::Message& message : peer.exchange->Take(kTakeWait)) {
      auto* snapshot = std::get_if<exchange::Snapshot>(&message);
      if (snapshot == nullptr || snapshot->agent != request.agent) continue;
      if (snapshot->client == request.client && snapshot->request == request.request) {
        return std::move(*snapshot);
      }
    }
  }
  return Fail(ErrorCode::kUnavailable,
              "{} does not answer within {:.1f} s: it is out of reach, or shows nothing; its agent "
              "is to run 'serve', or 'replay' or 'teach' with --server",
              options.robot, options.timeout_s);
}

int Run(const CLI::App& app, program::CommonOptions common, const SnapshotOptions& options) {
  if (const auto can = program::CanBeWritten(options.out); !can) {
    return program::Complain(app, can.error());
  }
  common.discovery = "mesh";
  const auto peer = fleet::JoinAsOperator(common, exchange::SnapshotTopics());
  if (!peer) return program::Complain(app, peer.error());
  const auto snapshot = Ask(*peer, options);
  if (!snapshot) return program::Complain(app, snapshot.error());
  if (snapshot->picture.empty()) {
    return program::Complain(
        app, {ErrorCode::kUnavailable, options.robot + " has no picture: " + snapshot->detail});
  }
  std::ofstream file(options.out, std::ios::binary | std::ios::trunc);
  file.write(reinterpret_cast<const char*>(snapshot->picture.data()),
             static_cast<std::streamsize>(snapshot->picture.size()));
  file.close();
  if (!file) {
    return program::Complain(
        app, {ErrorCode::kUnavailable, "cannot write " + options.out + ": is the disk full?"});
  }
  std::printf("%s\n", snapshot->detail.c_str());
  return program::kExitOk;
}

}  // namespace

Command AddSnapshotCommand(CLI::App& parent, const program::CommonOptions& common) {
  auto options = std::make_shared<SnapshotOptions>();
  CLI::App* app = parent.add_subcommand("snapshot", "What a robot's camera sees now, as a picture");
  app->footer(kSnapshotExamples);
  app->option_defaults()->always_capture_default();
  app->add_option("ROBOT", options->robot, "Its name, as --name of its agent")
      ->required()
      ->check(program::NameValidator());
  app->add_option("-o,--out", options->out, "The file, JPEG");
  app->add_option("--timeout", options->timeout_s, "Seconds to wait for its answer")
      ->check(CLI::Range(0.1, 3600.0));
  return {app, [app, options, &common] { return Run(*app, common, *options); }};
}

}  // namespace trailcast::tool
