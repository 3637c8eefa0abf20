#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "services/lab/trial/judge/recording_csv.h"
#include "services/lab/trial/judge/recording_report.h"
#include "services/lab/trial/trial_csv.h"
#include "services/tool/commands/command.h"

namespace trailcast::tool {
namespace {

constexpr const char* kFiguresExamples =
    "Examples:\n"
    "  trailcast figures indoor.csv paved.csv rough.csv > figures.md\n"
    "  trailcast figures tests/bench/results/*.csv";

int Run(const CLI::App& app, const std::vector<std::string>& files) {
  std::vector<trial::TrialRow> rows;
  std::vector<trial::RecordingRow> recordings;
  for (const std::string& file : files) {
    if (trial::IsRecordingCsv(file)) {
      const auto read = trial::ReadRecordingCsv(file);
      if (!read) return program::Complain(app, read.error());
      recordings.insert(recordings.end(), read->begin(), read->end());
      continue;
    }
    const auto read = trial::ReadTrialCsv(file);
    if (!read) return program::Complain(app, read.error());
    rows.insert(rows.end(), read->begin(), read->end());
  }
  if (!rows.empty()) std::fputs(trial::TrialMarkdown(rows).c_str(), stdout);
  if (!recordings.empty()) std::fputs(trial::RecordingMarkdown(recordings).c_str(), stdout);
  return program::kExitOk;
}

}  // namespace

Command AddFiguresCommand(CLI::App& parent) {
  auto files = std::make_shared<std::vector<std::string>>();
  CLI::App* app = parent.add_subcommand(
      "figures", "Tables in Markdown from the CSV files that trials wrote, beside the paper's");
  app->footer(kFiguresExamples);
  app->add_option("files", *files, "What 'trailcast trial --csv' and 'trailcast judge --csv' wrote")
      ->required()
      ->check(CLI::ExistingFile);
  return {app, [app, files] { return Run(*app, *files); }};
}

}  // namespace trailcast::tool
