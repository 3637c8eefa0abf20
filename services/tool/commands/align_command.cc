#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <thread>

#include "services/lab/trial/align/align.h"
#include "services/program/live_lines.h"
#include "services/program/output_file.h"
#include "services/program/stop_signal.h"
#include "services/tool/commands/command.h"

namespace trailcast::tool {
namespace {

struct AlignCommand {
  std::filesystem::path teach;
  std::filesystem::path replay;
  std::filesystem::path out;
  trial::AlignOptions options;
};

constexpr int kBarWidth = 40;

constexpr const char* kAlignExamples =
    "Examples:\n"
    "  trailcast align drive1/ drive2/ --out truth.csv\n"
    "  trailcast align drive1.mp4 drive2.mp4 --every 15 --teach-every 15 --out truth.csv   # long "
    "ones\n"
    "  trailcast judge drive1/ drive2/ --truth truth.csv\n"
    "\n"
    "Writes replay_frame,teach_frame,inliers,median_du_px,good: the frame of the taught recording\n"
    "that was taken where the replayed one was, by how many features that agree on one camera\n"
    "motion, how much further right these lie in the replayed picture (pixels; positive asks for "
    "a\n"
    "turn to the right), and whether they are enough (15). Frames are counted from 0. It looks at\n"
    "all of both recordings, backwards and forwards, and takes minutes: some 4 ms for each pair "
    "of\n"
    "frames it compares. Look at some of what it found before trusting it: where less than nine\n"
    "tenths are good, the recordings are hardly of one route, or too dark, or too blurred.";

int Run(const CLI::App& app, const AlignCommand& align) {
  if (auto writable = program::CanBeWritten(align.out); !writable) {
    return program::Complain(app, writable.error());
  }
  const program::StopSignal stop;
  program::LiveLines live(stderr, std::chrono::seconds(20));
  const auto aligned =
      trial::Align(align.teach, align.replay, align.options, [&](const char* doing, double share) {
        live.Show({fmt::format("{} {:>3.0f} %  {}", program::ProgressBar(share, kBarWidth),
                               100.0 * share, doing)});
        return !program::StopSignal::requested();
      });
  if (!aligned) return program::Complain(app, aligned.error());
  for (const std::string& each : aligned->news) fmt::print(stderr, "{}\n", each);
  const trial::Reference& reference = aligned->reference;
  if (auto written = trial::WriteReference(reference, align.out); !written) {
    return program::Complain(app, written.error());
  }
  const auto good = std::count_if(reference.begin(), reference.end(),
                                  [](const trial::Alignment& row) { return row.good; });
  fmt::print("{}: {} frames of the replayed recording, {} of them good ({:.0f} %)\n",
             align.out.string(), reference.size(), good,
             100.0 * static_cast<double>(good) / static_cast<double>(reference.size()));
  return program::kExitOk;
}

}  // namespace

Command AddAlignCommand(CLI::App& parent) {
  auto align = std::make_shared<AlignCommand>();
  align->options.jobs = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  CLI::App* app = parent.add_subcommand(
      "align",
      "Find out where on one recording the frames of another were taken: a truth for "
      "'judge'");
  app->footer(kAlignExamples);
  app->add_option("teach", align->teach,
                  "The recording that teaches: a folder of pictures or a video")
      ->required();
  app->add_option("replay", align->replay, "The one that is replayed")->required();
  app->add_option("--out", align->out, "Where the alignment goes (CSV)")->required();
  app->add_option("--every", align->options.every,
                  "Looks at every so many frames of the replayed recording")
      ->check(CLI::Range(1, 10'000));
  app->add_option("--teach-every", align->options.teach_every,
                  "The same of the taught one: places are told no closer than this")
      ->check(CLI::Range(1, 10'000));
  app->add_option("--jobs", align->options.jobs, "Threads; the result does not depend on it")
      ->check(CLI::Range(1, 256));
  return {app, [app, align] { return Run(*app, *align); }};
}

}  // namespace trailcast::tool
