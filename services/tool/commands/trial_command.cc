#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "agent/device/device_options.h"
#include "services/lab/trial/flaws.h"
#include "services/lab/trial/scenario.h"
#include "services/lab/trial/spoiled_eyes.h"
#include "services/lab/trial/trial_batch.h"
#include "services/lab/trial/trial_csv.h"
#include "services/lab/trial/trial_plot.h"
#include "services/program/live_lines.h"
#include "services/tool/commands/command.h"

namespace trailcast::tool {
namespace {

struct TrialFiles {
  std::string csv;
  std::string plot;
};

constexpr int kBarWidth = 40;

constexpr const char* kTrialExamples =
    "Examples:\n"
    "  trailcast trial --scenario cameras --trials 1 --csv pairs.csv\n"
    "  trailcast trial --scenario indoor --method paper --trials 10 --csv out.csv --plot out.png\n"
    "  trailcast trial --scenario paved --method default,paper,icra2006   # a column of Table I\n"
    "  trailcast trial --scenario rough --method paper,icra2006 --same-robot   # as the paper did\n"
    "  trailcast trial --scout-camera webcam --follower-camera wide --trials 3\n"
    "  trailcast trial --scenario loop --laps 10 --trials 1   # does it drift from lap to lap?\n"
    "  trailcast trial --scenario seasons --visits 10 --refresh --trials 3\n"
    "  trailcast trial --scenario indoor --matrix --trials 10 --csv matrix.csv\n"
    "  trailcast trial --flaw upside-down,late,all --trials 3   # as real robots are\n"
    "  trailcast trial --world place.glb --up y --path path.csv --speed 0.5 --seed 7\n"
    "  trailcast trial --trials 3 --log logs/   # then: trailcast explain logs/...-trial2.mcap\n"
    "  trailcast trial --trials 1 --seed 4      # the fourth of ten trials from seed 1, alone";

std::string ScenarioHelp() {
  std::string help = "A built-in one:";
  for (const trial::Scenario& each : trial::Scenarios())
    help += fmt::format("\n{:<8} {}", each.name, each.summary);
  return help;
}

std::string FlawHelp() {
  std::string help = "What is wrong with the follower, one or several, each in trials of its own:";
  for (const trial::Flaw& each : trial::Flaws())
    help += fmt::format("\n{:<15} {}", each.name, each.summary);
  return help;
}

void AddOptions(CLI::App& app, trial::TrialOptions& options, TrialFiles& files) {
  app.option_defaults()->always_capture_default();
  CLI::Option* scenario = app.add_option("--scenario", options.scenario, ScenarioHelp());
  CLI::Option* world =
      app.add_option("--world", options.place.world, "A world of your own: glTF, OBJ, ...")
          ->check(CLI::ExistingFile)
          ->excludes(scenario);
  app.add_option("--up", options.place.up, "Which axis of the world file is up")
      ->check(CLI::IsMember({"y", "z"}))
      ->needs(world);
  app.add_option("--scale", options.place.scale, "Metres per unit of the world file")
      ->check(CLI::PositiveNumber)
      ->needs(world);
  app.add_option("--path", options.place.path, "Way-points: CSV with the header x_m,y_m[,z_m]")
      ->check(CLI::ExistingFile)
      ->needs(world);
  app.add_option("--ground", options.place.ground,
                 "What robots stand on: the world's surfaces, or z = 0")
      ->check(CLI::IsMember({"mesh", "flat"}))
      ->needs(world);
  app.add_option("--method", options.methods,
                 fmt::format("How to follow: {}; several, with commas between, follow the same "
                             "teachings side by side",
                             fmt::join(agent::ReplayMethodNames(), ", ")))
      ->delimiter(',');
  app.add_option(
      "--scout-camera", options.scout_camera,
      fmt::format("{}, or a camera file (.toml); with what is other about it, by that file's keys: "
                  "webcam+roll_deg=180+ahead_m=0.3",
                  fmt::join(trial::CameraNames(), ", ")));
  app.add_option("--follower-camera", options.follower_camera, "The same");
  const auto add_roll = [&app](const char* flag, double& roll_deg) {
    app.add_option(flag, roll_deg, "What that robot is told by --camera-roll, degrees")
        ->check(agent::CameraRollValidator());
  };
  add_roll("--scout-camera-roll", options.scout_roll_deg);
  add_roll("--follower-camera-roll", options.follower_roll_deg);
  app.add_option("--follower-camera-ahead", options.follower_ahead_m,
                 "What the follower is told by --camera-ahead, metres")
      ->check(agent::CameraAheadRange());
  app.add_option("--pass-obstacles", options.pass_obstacles_m,
                 "What a follower with a scanner is told by --pass-obstacles, metres; 0: it waits")
      ->check(CLI::Range(0.0, 2.0));
  app.add_option("--odometry", options.odometry,
                 "Who has odometry; a follower without it goes by what it tells its base to drive")
      ->check(CLI::IsMember({"both", "scout", "follower", "none"}));
  app.add_option(
      "--odometry-noise", options.odometry_noise,
      "What is wrong with the follower's, joined with '+':\n" + trial::OdometryNoiseHelp());
  app.add_option("--flaw", options.flaws, FlawHelp())->delimiter(',');
  app.add_option("--speed", options.speed_mps, "The scout's, m/s; 0: the scenario's")
      ->check(CLI::Range(0.0, 1.0));
  app.add_option("--trials", options.trials, "How many")->check(CLI::Range(1, 10000));
  app.add_flag(
      "--same-robot", options.same_robot,
      "The robot that taught follows, with the same camera, mount and wheels, past nobody, "
      "under the same sun: how Chen & Birchfield measured. Otherwise another robot does");
  app.add_option("--laps", options.laps,
                 "How often each follower drives the route, without a pause, of a path that ends "
                 "where it begins")
      ->check(CLI::Range(1, 1000));
  app.add_flag("--backwards", options.backwards,
               "Followers drive in reverse gear from the taught path's end to its beginning");
  app.add_flag("--matrix", options.matrix,
               "So many trials of each of twelve tasks: begin on the path or beside it, go to its "
               "end, back to its beginning or to any point, with the scout's camera or another "
               "one of 80 to 140 degrees at 0.4 to 1.7 m; one table");
  app.add_option("--starts", options.starts,
                 "Followers are set down at so many drawn places along each taught route, told of "
                 "none, and judged by where they take themselves to be and by the metres after")
      ->check(CLI::Range(1, 1000));
  CLI::Option* visits =
      app.add_option("--visits", options.visits,
                     "Each taught route is followed so many times, by one robot after the other, "
                     "while the scenario's change (night, seasons, moved) grows to all of it")
          ->check(CLI::Range(1, 1000));
  app.add_option("--spoiled", options.spoiled,
                 "What is wrong with all of these visitors; after them comes one more with whom "
                 "nothing is, and shows what they have made of the route")
      ->check(CLI::IsMember(trial::SpoiledNames()))
      ->needs(visits);
  app.add_flag("--refresh", options.refresh,
               "Each visit refreshes the route for the next one: features long missed are "
               "dropped, some of those it saw are added")
      ->needs(visits);
  app.add_option("--told", options.told_m,
                 "They are told their places, off by so many metres (one sigma), as by who sends "
                 "them along a part of a route")
      ->needs("--starts")
      ->check(CLI::Range(0.0, 10.0));
  app.add_option("--seed", options.seed, "Trial i is drawn from this plus i - 1");
  app.add_option("--jobs", options.jobs, "Trials run at a time; the results do not depend on it")
      ->check(CLI::Range(1, 256));
  app.add_option("--csv", files.csv, "Where one row a trial goes");
  app.add_option("--log", options.log_folder,
                 "Folder for one log a trial, named by scenario, method, cameras and trial: see "
                 "'trailcast explain'");
  app.add_option("--plot", files.plot,
                 "Where a picture (PNG, or SVG by its name) of the paths goes");
}

std::string ProgressLine(double share, int ended, int arrived, int trials) {
  return fmt::format("{} {:>3.0f} %  {} of {} trials ended, {} arrived",
                     program::ProgressBar(share, kBarWidth), 100.0 * share, ended, trials, arrived);
}

int Run(const CLI::App& app, const trial::TrialOptions& options, const TrialFiles& files) {
  const auto setup = trial::PrepareTrials(options);
  if (!setup) return program::Complain(app, setup.error());
  for (const std::string& warning : setup->world->warnings()) {
    fmt::print(stderr, "{}: {}\n", app.get_name(), warning);
  }
  const int all = options.trials * static_cast<int>(setup->cases.size());
  program::LiveLines live(stderr, std::chrono::seconds(20));
  const auto outcomes =
      trial::RunTrials(*setup, options, [&](double share, int ended, int arrived) {
        live.Show({ProgressLine(share, ended, arrived, all)}, ended == all);
      });
  if (!outcomes) return program::Complain(app, outcomes.error());
  std::vector<trial::TrialRow> rows;
  for (const trial::TrialOutcome& outcome : *outcomes) rows.push_back(outcome.row);
  std::fputs(trial::TrialTable(rows).c_str(), stdout);
  if (!files.csv.empty()) {
    const auto written = trial::WriteTrialCsv(rows, files.csv);
    if (!written) return program::Complain(app, written.error());
  }
  if (!files.plot.empty()) {
    const auto written = trial::WriteTrialPlot(*setup, *outcomes, files.plot);
    if (!written) return program::Complain(app, written.error());
  }
  return program::kExitOk;
}

}  // namespace

Command AddTrialCommand(CLI::App& parent) {
  auto options = std::make_shared<trial::TrialOptions>();
  auto files = std::make_shared<TrialFiles>();
  CLI::App* app = parent.add_subcommand(
      "trial", "Teach and follow in a simulated world, and measure how well it went");
  app->footer(kTrialExamples);
  AddOptions(*app, *options, *files);
  return {app, [app, options, files] { return Run(*app, *options, *files); }};
}

}  // namespace trailcast::tool
