#include <fmt/format.h>

#include <algorithm>

#include "services/lab/trial/trial_report.h"

namespace trailcast::trial {
namespace {

// Returns accuracy, repeatability and largest final error in the paper's form.
std::string Three(double accuracy_m, double repeatability_m, double largest_m) {
  return fmt::format("{:.2f} / {:.2f}, {:.2f}", accuracy_m, repeatability_m, largest_m);
}

std::string Table1Line(const std::vector<TrialRow>& rows, const PaperFigures& paper) {
  const TrialSummary summary = Summarize(rows);
  return fmt::format(
      "| `{}`{} | `{}` | {} of {} | {} | {} |\n", rows.front().scenario,
      rows.front().same_robot ? ", same robot" : "", rows.front().method, summary.arrived,
      summary.trials,
      Three(summary.accuracy_m, summary.repeatability_m, summary.largest_final_error_m),
      rows.front().method == "default"
          ? fmt::format("({})",
                        Three(paper.accuracy_m, paper.repeatability_m, paper.largest_final_error_m))
          : Three(paper.accuracy_m, paper.repeatability_m, paper.largest_final_error_m));
}

std::string CaseLine(const std::vector<TrialRow>& rows) {
  const TrialSummary s = Summarize(rows);
  std::string line = fmt::format(
      "| `{}` | {} | {} of {} | {:.3f} | {:.3f} | {:.3f} | {:.3f} | {:.3f} | {:.3f} | {:.0f} % | "
      "{:.0f} | {:.0f} | {:.2f} |",
      rows.front().scenario, CaseName(rows.front()), s.arrived, s.trials, s.accuracy_m,
      s.repeatability_m, s.largest_final_error_m, s.mean_path_error_m, s.p90_path_error_m,
      s.max_path_error_m, 100.0 * s.found_share, s.segments, s.bytes_per_m, s.ms_per_frame);
  double largest_m = -1.0;
  for (const TrialRow& row : rows) {
    largest_m = std::max(largest_m, row.verdict.after_push_m.value_or(-1.0));
  }
  return line + (largest_m < 0.0 ? " |\n" : fmt::format(" {:.2f} |\n", largest_m));
}

std::vector<std::vector<std::vector<TrialRow>>> ByScenario(const std::vector<TrialRow>& rows) {
  std::vector<std::vector<TrialRow>> scenarios;
  for (const TrialRow& row : rows) {
    const auto same = std::find_if(scenarios.begin(), scenarios.end(), [&](const auto& others) {
      return others.front().scenario == row.scenario;
    });
    (same == scenarios.end() ? scenarios.emplace_back() : *same).push_back(row);
  }
  std::vector<std::vector<std::vector<TrialRow>>> cases;
  cases.reserve(scenarios.size());
  for (const auto& each : scenarios) cases.push_back(Cases(each));
  return cases;
}

}  // namespace

std::string TrialMarkdown(const std::vector<TrialRow>& rows) {
  std::string table1;
  std::string all;
  for (const auto& scenario : ByScenario(rows)) {
    for (const std::vector<TrialRow>& each : scenario) {
      if (const auto paper = PaperFiguresFor(each.front())) table1 += Table1Line(each, *paper);
      all += CaseLine(each);
    }
  }
  std::string text;
  if (!table1.empty()) {
    text +=
        "| scenario | method | arrived | ours: accuracy / repeatability, largest final error, m | "
        "the paper |\n| --- | --- | --- | --- | --- |\n" +
        table1 + "\n";
  }
  return text +
         "| scenario | case | arrived | accuracy m | repeatability m | largest final m | mean off "
         "path m | nine tenths within m | largest off path m | found | segments | B/m | ms/frame | "
         "10 m after push m |\n"
         "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |\n" +
         all;
}

}  // namespace trailcast::trial
