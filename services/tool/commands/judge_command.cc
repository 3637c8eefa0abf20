#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "services/image/files.h"
#include "services/lab/trial/judge/frames_csv.h"
#include "services/lab/trial/judge/recording_batch.h"
#include "services/lab/trial/judge/recording_csv.h"
#include "services/lab/trial/judge/recording_plot.h"
#include "services/lab/trial/judge/recording_report.h"
#include "services/lab/trial/recording/odometry_noise.h"
#include "services/program/live_lines.h"
#include "services/program/output_file.h"
#include "services/tool/commands/command.h"

namespace trailcast::tool {
namespace {

namespace fs = std::filesystem;

struct JudgeCommand {
  fs::path teach;
  std::vector<fs::path> replays;
  std::vector<fs::path> visits;
  std::string visits_disturbance;
  fs::path truth;
  fs::path steering;
  fs::path teach_odometry;
  fs::path replay_odometry;
  std::optional<double> rate_hz;
  std::vector<std::string> disturbances{"none"};
  std::vector<std::string> odometry_noises{"none"};
  fs::path pairs;
  fs::path data;
  std::string method = "default";
  std::string start = "beginning";
  std::pair<int, int> steering_lead{2, 5};
  trial::RecordingOptions options;
  int jobs = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  fs::path csv;
  fs::path plot;
  fs::path frames;
};

constexpr int kBarWidth = 40;

constexpr const char* kJudgeExamples =
    "Examples:\n"
    "  trailcast judge drive1/ drive1/                        # is what was taught followed?\n"
    "  trailcast align drive1/ drive2/ --out truth.csv        # where drive2 really was\n"
    "  trailcast judge drive1/ drive2/ --truth truth.csv --csv judged.csv --plot judged.png\n"
    "  trailcast judge drive1/ drive2/ --truth truth.csv --disturb "
    "none,camera,every=3,jpeg=30+noise=8\n"
    "  trailcast judge drive1/ drive2/ --truth truth.csv --start anywhere --disturb "
    "from=0.2,from=0.7\n"
    "  trailcast judge drive1/ drive3/ --truth truth3.csv --visit drive2/   # who refreshed it\n"
    "  trailcast judge drive1/ other-hall/                    # must not be followed\n"
    "  trailcast judge --pairs pairs.csv --data recordings/ --csv judged.csv\n"
    "\n"
    "Open loop: the pictures do not turn where the robot would. The figures, by frames:\n"
    "  following    of all frames: FOLLOWING, or ARRIVED\n"
    "  right        of those that the truth knows: following, within 5 % of the taught recording\n"
    "               of the place where they were taken\n"
    "  wrong        of the same: following elsewhere\n"
    "  lost         of all frames: LOST\n"
    "  found again  how often it was right within 2 s, of the times that it was not right after "
    "it\n"
    "               had been, or after a cut\n"
    "  side         while FOLLOWING, where features lie aside by more than 1.25 % of the "
    "picture's\n"
    "               width: turns asked for to that side\n"
    "  correct      the same, of the turn less what the taught frame itself asks for: without the\n"
    "               route's own bends\n"
    "  steering     while FOLLOWING, where the driver steered more than 0.3: turns asked for to\n"
    "               that side, over all leads\n"
    "\n"
    "A file of pairs is a CSV with the columns teach,replay and, as far as they are needed,\n"
    "kind (identity, right, wrong), set (pairs that make a column of the tables), truth, "
    "steering,\n"
    "disturb, teach_odometry, replay_odometry, odometry_noise, rate, visits (with + between),\n"
    "disturb_visits.\n"
    "\n"
    "Disturbances, drawn from --seed; several are joined with '+':\n";

void AddPairOptions(CLI::App& app, JudgeCommand& judge) {
  auto* teach = app.add_option("teach", judge.teach,
                               "The recording that teaches: a folder of pictures (in the order of "
                               "their names) or a video");
  auto* replays =
      app.add_option("replay", judge.replays, "Those that are replayed on its route")->needs(teach);
  app.add_option(
         "--visit", judge.visits,
         "A recording whose robot follows the route before, and refreshes it if it arrives; "
         "several: one after the other")
      ->allow_extra_args(false)
      ->needs(replays);
  app.add_option("--disturb-visits", judge.visits_disturbance,
                 "What is done to all of these; see below")
      ->needs(replays);
  app.add_option("--truth", judge.truth,
                 "Where the replayed frames were taken, as 'trailcast align' writes it")
      ->needs(replays);
  app.add_option("--steering", judge.steering,
                 "How the replay's driver steered: CSV frame,steering, above 0 to the right")
      ->needs(replays);
  app.add_option("--teach-odometry", judge.teach_odometry,
                 "CSV t_s,x_m,y_m,heading_rad, times counted from the first frame; default: vision "
                 "only")
      ->needs(teach);
  app.add_option("--replay-odometry", judge.replay_odometry, "The same, of the replay")
      ->needs(replays);
  app.add_option("--odometry-noise", judge.odometry_noises,
                 "What is wrong with the replay's odometry: see below; with commas between, one "
                 "after the other")
      ->delimiter(',')
      ->take_all()
      ->allow_extra_args(false)
      ->needs("--replay-odometry");
  app.add_option("--rate", judge.rate_hz, "Frames a second; default: the video's own, or 30")
      ->check(CLI::Range(0.1, 1000.0));
  app.add_option("--disturb", judge.disturbances,
                 "What is done to the replay: see below; with commas between, one after the other")
      ->delimiter(',')
      ->take_all()
      ->allow_extra_args(false)
      ->needs(replays);
  auto* pairs =
      app.add_option("--pairs", judge.pairs, "A file of pairs, in place of two recordings")
          ->excludes(teach);
  app.add_option("--data", judge.data, "Folder of that file's recordings; default: the file's own")
      ->needs(pairs);
}

void AddOptions(CLI::App& app, JudgeCommand& judge) {
  AddPairOptions(app, judge);
  app.option_defaults()->always_capture_default();
  app.add_option("--method", judge.method, "How to follow")
      ->check(CLI::IsMember(agent::ReplayMethodNames()));
  app.add_option("--start", judge.start,
                 "Where followers take themselves to be at first: at the route's beginning, or "
                 "anywhere on it")
      ->check(CLI::IsMember({"beginning", "anywhere"}));
  app.add_option(
      "--steering-lead", judge.steering_lead,
      "Frames by which the driver's hand is ahead of the picture, from and to; default: 2 5");
  app.add_option("--seed", judge.options.seed, "Draws what is to be drawn");
  app.add_option("--jobs", judge.jobs, "Replays run at a time; the results do not depend on it")
      ->check(CLI::Range(1, 256));
  app.add_option("--csv", judge.csv,
                 "Where one row a replay goes; 'trailcast figures' makes tables "
                 "of such files");
  app.add_option("--plot", judge.plot,
                 "Where a picture (PNG, or SVG by its name) of places and truth goes");
  app.add_option("--frames-csv", judge.frames,
                 "Folder for one CSV a replay, of what was told and what is true frame by frame");
  app.add_option("--log", judge.options.logs,
                 "Folder for one log a replay: see 'trailcast explain'");
}

bool IsSame(const fs::path& one, const fs::path& other) {
  std::error_code error;
  return fs::equivalent(one, other, error) && !error;
}

// Returns the last two parts of its path: "drives/monday".
std::string ShortName(const fs::path& recording) {
  const fs::path whole = fs::absolute(recording).lexically_normal();
  const fs::path path = whole.has_filename() ? whole : whole.parent_path();
  return (path.parent_path().filename() / path.filename()).string();
}

// Returns what each replay of a recording does to the pictures, and to the odometry.
std::vector<std::pair<std::string, std::string>> Each(const JudgeCommand& judge) {
  std::vector<std::pair<std::string, std::string>> each;
  for (const std::string& disturbance : judge.disturbances) {
    for (const std::string& noise : judge.odometry_noises) each.emplace_back(disturbance, noise);
  }
  return each;
}

Result<std::vector<trial::RecordingPair>> PairsOf(const JudgeCommand& judge) {
  if (!judge.pairs.empty()) {
    return trial::ReadPairs(judge.pairs,
                            judge.data.empty() ? judge.pairs.parent_path() : judge.data);
  }
  if (judge.replays.size() > 1 && (!judge.truth.empty() || !judge.steering.empty())) {
    return Fail(ErrorCode::kInvalidArgument,
                "--truth and --steering are of one replay: give one, or --pairs");
  }
  std::vector<std::string> disturbances = judge.disturbances;
  disturbances.push_back(judge.visits_disturbance);
  for (const std::string& disturbance : disturbances) {
    const auto parsed = trial::ParseDisturbance(disturbance);
    if (!parsed) return tl::unexpected(parsed.error());
  }
  for (const std::string& noise : judge.odometry_noises) {
    if (auto parsed = trial::ParseOdometryNoise(noise); !parsed) {
      return tl::unexpected(parsed.error());
    }
  }
  std::vector<trial::RecordingPair> pairs;
  for (const fs::path& replay : judge.replays) {
    for (const auto& [disturbance, noise] : Each(judge)) {
      trial::RecordingPair pair;
      pair.kind =
          IsSame(judge.teach, replay) ? trial::PairKind::kIdentity : trial::PairKind::kRight;
      pair.teach_name = ShortName(judge.teach);
      pair.replay_name = ShortName(replay);
      pair.teach = {judge.teach, judge.teach_odometry, judge.rate_hz};
      pair.replay = {replay, judge.replay_odometry, judge.rate_hz};
      for (const fs::path& visit : judge.visits) pair.visits.push_back({visit, {}, judge.rate_hz});
      pair.visits_disturbance = judge.visits_disturbance;
      pair.reference = judge.truth;
      pair.steering = judge.steering;
      pair.disturbance = disturbance == "none" ? "" : disturbance;
      pair.odometry_noise = noise;
      pairs.push_back(std::move(pair));
    }
  }
  return pairs;
}

Result<void> Write(const JudgeCommand& judge, const std::vector<trial::RecordingRow>& rows,
                   const std::vector<trial::RecordingOutcome>& outcomes) {
  if (!judge.csv.empty()) {
    if (auto written = trial::WriteRecordingCsv(rows, judge.csv); !written) return written;
  }
  if (!judge.frames.empty()) {
    if (auto written = trial::WriteFramesCsv(outcomes, judge.frames); !written) return written;
  }
  if (judge.plot.empty()) return {};
  return trial::DrawRecordings(outcomes).Write(judge.plot);
}

int Run(const CLI::App& app, JudgeCommand& judge) {
  for (const fs::path& file : {judge.csv, judge.plot}) {
    if (auto writable = program::CanBeWritten(file); !writable)
      return program::Complain(app, writable.error());
  }
  const auto pairs = PairsOf(judge);
  if (!pairs) return program::Complain(app, pairs.error());
  const auto method = agent::FindReplayMethod(judge.method);
  if (!method) return program::Complain(app, method.error());
  judge.options.method = *method;
  judge.options.anywhere = judge.start == "anywhere";
  judge.options.judging.steering_leads_least = judge.steering_lead.first;
  judge.options.judging.steering_leads_most = judge.steering_lead.second;
  program::LiveLines live(stderr, std::chrono::seconds(20));
  auto results =
      trial::RunRecordingTrials(*pairs, judge.options, judge.jobs, [&](double share, int ended) {
        live.Show({fmt::format("{} {:>3.0f} %  {} of {} replays ended",
                               program::ProgressBar(share, kBarWidth), 100.0 * share, ended,
                               pairs->size())},
                  static_cast<std::size_t>(ended) == pairs->size());
      });
  std::vector<trial::RecordingOutcome> outcomes;
  std::vector<trial::RecordingRow> rows;
  int status = program::kExitOk;
  for (const Error& error : trial::ErrorsOf(results)) status = program::Complain(app, error);
  for (Result<trial::RecordingOutcome>& result : results) {
    if (!result) continue;
    rows.push_back(result->row);
    outcomes.push_back(*std::move(result));
  }
  if (rows.empty()) return status;
  std::fputs(trial::RecordingTable(rows).c_str(), stdout);
  const auto written = Write(judge, rows, outcomes);
  return written ? status : program::Complain(app, written.error());
}

}  // namespace

Command AddJudgeCommand(CLI::App& parent) {
  auto judge = std::make_shared<JudgeCommand>();
  CLI::App* app = parent.add_subcommand(
      "judge", "Teach and replay recordings, and measure how well the route was followed");
  app->footer(kJudgeExamples + trial::ChangeHelp() +
              "\nWhat may be wrong with odometry, several joined with '+':\n" +
              trial::OdometryNoiseHelp());
  AddOptions(*app, *judge);
  app->callback([judge] {
    if (judge->replays.empty() && judge->pairs.empty()) {
      throw CLI::RequiredError("a recording to teach and one to replay, or --pairs");
    }
  });
  return {app, [app, judge] { return Run(*app, *judge); }};
}

}  // namespace trailcast::tool
