#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

#include "agent/diagnosis/run_log_reader.h"
#include "services/explain/run_plot.h"
#include "services/explain/story.h"
#include "services/image/files.h"
#include "services/tool/commands/command.h"

namespace trailcast::tool {
namespace {

struct ExplainOptions {
  std::filesystem::path log;
  std::filesystem::path plot;
  bool no_plot = false;
  bool all = false;
};

constexpr const char* kExplainExamples =
    "Examples:\n"
    "  trailcast-agent replay --frames drive2/ --route hall --store scout.db --log run.mcap\n"
    "  trailcast explain run.mcap                  # the story, and run.png beside it\n"
    "  trailcast explain run.mcap --all --no-plot  # everything, in words only\n"
    "  trailcast trial --trials 3 --log logs/ && trailcast explain "
    "logs/indoor-default-*-trial2.mcap\n"
    "The story says where (metres driven, share of the route, segment) the robot was unsure, "
    "blind\n"
    "or covered and why, which hand-overs found little, which milestones it missed. The picture\n"
    "shows the path, the turns, the features and the estimate over the distance. A log that was\n"
    "cut off or damaged is told as far as it is whole.";

int Run(const CLI::App& app, const ExplainOptions& options) {
  const auto log = agent::ReadRunLog(options.log);
  if (!log) return program::Complain(app, log.error());
  std::fputs(explain::TellStory(*log, options.all).c_str(), stdout);
  if (options.no_plot || log->frames.empty()) return program::kExitOk;
  std::filesystem::path plot = options.plot;
  if (plot.empty()) plot = std::filesystem::path(options.log).replace_extension(".png");
  if (auto written = explain::DrawRun(*log).Write(plot); !written) {
    return program::Complain(app, written.error());
  }
  fmt::print("\nDrawn in {}\n", plot.string());
  return program::kExitOk;
}

}  // namespace

Command AddExplainCommand(CLI::App& parent) {
  auto options = std::make_shared<ExplainOptions>();
  CLI::App* app = parent.add_subcommand(
      "explain", "Tell in plain words, and draw, what happened in a replay that wrote a log");
  app->footer(kExplainExamples);
  app->add_option("log", options->log,
                  "What 'trailcast-agent replay --log', 'serve --logs' or 'trial --log' wrote")
      ->required();
  CLI::Option* plot =
      app->add_option("--plot", options->plot,
                      "Where the picture (PNG, or SVG by its name) goes; default: beside the log");
  app->add_flag("--no-plot", options->no_plot, "No picture")->excludes(plot);
  app->add_flag("--all", options->all, "Everything that happened, and all events of the log");
  return {app, [app, options] { return Run(*app, *options); }};
}

}  // namespace trailcast::tool
