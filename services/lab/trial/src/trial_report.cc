#include "services/lab/trial/trial_report.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>

namespace trailcast::trial {
namespace {

template <typename Value>
double Mean(const std::vector<TrialRow>& rows, Value value) {
  double sum = 0.0;
  for (const TrialRow& row : rows) sum += value(row);
  return sum / static_cast<double>(rows.size());
}

template <typename Value>
double Largest(const std::vector<TrialRow>& rows, Value value) {
  double largest = 0.0;
  for (const TrialRow& row : rows) largest = std::max(largest, static_cast<double>(value(row)));
  return largest;
}

std::string SummaryLine(const char* what, const std::string& ours, const std::string& paper) {
  return fmt::format("  {:<32}{:>12}{:>12}\n", what, ours, paper);
}

}  // namespace

TrialSummary Summarize(const std::vector<TrialRow>& rows) {
  TrialSummary summary;
  if (rows.empty()) return summary;
  // Each trial teaches anew, so the ends differ by centimetres. Positions are therefore compared as
  // offsets from the taught end.
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (const TrialRow& row : rows) mean += row.verdict.final_m - row.end_m;
  mean /= static_cast<double>(rows.size());
  summary.trials = static_cast<int>(rows.size());
  summary.arrived = static_cast<int>(
      std::count_if(rows.begin(), rows.end(), [](const TrialRow& row) { return row.arrived; }));
  summary.accuracy_m = std::sqrt(Mean(rows, [](const TrialRow& row) {
    return row.verdict.final_error_m * row.verdict.final_error_m;
  }));
  summary.repeatability_m = std::sqrt(Mean(rows, [&](const TrialRow& row) {
    return (row.verdict.final_m - row.end_m - mean).squaredNorm();
  }));
  summary.largest_final_error_m =
      Largest(rows, [](const TrialRow& row) { return row.verdict.final_error_m; });
  summary.mean_path_error_m =
      Mean(rows, [](const TrialRow& row) { return row.verdict.mean_path_error_m; });
  summary.p90_path_error_m =
      Largest(rows, [](const TrialRow& row) { return row.verdict.p90_path_error_m; });
  summary.max_path_error_m =
      Largest(rows, [](const TrialRow& row) { return row.verdict.max_path_error_m; });
  summary.found_share = Mean(rows, [](const TrialRow& row) { return row.found_share; });
  summary.segments = Mean(rows, [](const TrialRow& row) { return row.segments; });
  summary.bytes_per_m = Mean(rows, [](const TrialRow& row) { return row.bytes_per_m; });
  summary.ms_per_frame = Mean(rows, [](const TrialRow& row) { return row.ms_per_frame; });
  return summary;
}

std::optional<PaperFigures> PaperFiguresFor(const TrialRow& row) {
  const auto scenario = FindScenario(row.scenario);
  if (!scenario) return std::nullopt;
  return row.method == "icra2006" ? scenario->icra2006 : scenario->paper;
}

std::string CaseName(const TrialRow& row) {
  std::string name =
      fmt::format("{:<8} {} > {}", row.method, row.scout_camera, row.follower_camera);
  if (row.same_robot) name += ", same robot";
  if (row.push_m != 0.0) name += fmt::format(", pushed {:+.0f} m", row.push_m);
  if (!row.flaw.empty()) name += ", " + row.flaw;
  if (row.cell) name += ", " + ToText(*row.cell);
  return name;
}

std::vector<std::vector<TrialRow>> Cases(const std::vector<TrialRow>& rows) {
  std::vector<std::vector<TrialRow>> cases;
  for (const TrialRow& row : rows) {
    const auto same = std::find_if(cases.begin(), cases.end(), [&](const auto& others) {
      return CaseName(others.front()) == CaseName(row);
    });
    (same == cases.end() ? cases.emplace_back() : *same).push_back(row);
  }
  return cases;
}

namespace {

std::string RowTable(const std::vector<TrialRow>& rows) {
  std::string text =
      fmt::format("{:>5}{:>8} {:<10}{:>9}{:>9}{:>9}{:>7}{:>9}{:>8}{:>10}\n", "trial", "seed",
                  "state", "end m", "mean m", "max m", "found", "segments", "B/m", "ms/frame");
  for (const TrialRow& row : rows) {
    text += fmt::format("{:>5}{:>8} {:<10}{:>9.3f}{:>9.3f}{:>9.3f}{:>6.0f}%{:>9}{:>8.0f}{:>10.2f}",
                        row.trial, row.seed, row.state, row.verdict.final_error_m,
                        row.verdict.mean_path_error_m, row.verdict.max_path_error_m,
                        100.0 * row.found_share, row.segments, row.bytes_per_m, row.ms_per_frame);
    if (row.push_m != 0.0) {
      text += row.verdict.after_push_m
                  ? fmt::format("  {:.2f} m off 10 m after a push of {:+.0f} m",
                                *row.verdict.after_push_m, row.push_m)
                  : fmt::format("  pushed {:+.0f} m", row.push_m);
    }
    if (row.lap_ends_m.size() > 1) {
      text += fmt::format("  laps end {:.2f} m off", fmt::join(row.lap_ends_m, ", "));
    }
    if (row.scan) {
      text +=
          fmt::format("  waited {:.1f} s, {} {:.2f} m off what it scanned", row.scan->waited_s,
                      row.scan->touched ? "touched something," : "nearest", row.scan->nearest_m);
    }
    if (row.found) {
      text += fmt::format("  set down at {:.2f} m, found after {:.1f} s, {:+.2f} m off",
                          row.found->at_m, row.found->after_s, row.found->off_m);
    }
    if (row.visit > 0) text += fmt::format("  visit {}", row.visit);
    text += row.reason.empty() ? "\n" : fmt::format("  {}\n", row.reason);
  }
  return text;
}

// Writes a line for each case, with the paper's own figures below those that it has.
std::string CaseTable(const std::vector<std::vector<TrialRow>>& cases) {
  std::string text = fmt::format("{:<36}{:>9}{:>9}{:>9}{:>9}{:>9}{:>9}{:>7}\n", "case", "arrived",
                                 "accuracy", "repeat", "largest", "mean m", "max m", "found");
  for (const std::vector<TrialRow>& rows : cases) {
    const TrialSummary summary = Summarize(rows);
    text += fmt::format(
        "{:<36}{:>9}{:>9.3f}{:>9.3f}{:>9.3f}{:>9.3f}{:>9.3f}{:>6.0f}%\n", CaseName(rows.front()),
        fmt::format("{}/{}", summary.arrived, summary.trials), summary.accuracy_m,
        summary.repeatability_m, summary.largest_final_error_m, summary.mean_path_error_m,
        summary.max_path_error_m, 100.0 * summary.found_share);
    if (const auto paper = PaperFiguresFor(rows.front())) {
      text += fmt::format("{:<36}{:>9}{:>9.2f}{:>9.2f}{:>9.2f}\n", "  in the paper", "",
                          paper->accuracy_m, paper->repeatability_m, paper->largest_final_error_m);
    }
  }
  return text;
}

// Writes a table of followers that were set down anywhere, for which the end of the path means
// nothing.
std::string FoundTable(const std::vector<TrialRow>& rows) {
  std::vector<double> off_m;
  std::vector<double> after_s;
  int within = 0;
  int arrived = 0;
  for (const TrialRow& row : rows) {
    arrived += row.arrived ? 1 : 0;
    if (!row.found) continue;
    off_m.push_back(std::abs(row.found->off_m));
    after_s.push_back(row.found->after_s);
    if (off_m.back() <= 0.5 * row.taught_m / std::max(1, row.segments)) ++within;
  }
  const TrialRow& first = rows.front();
  std::string text =
      fmt::format("{}, method {}, taught by {}, followed by {} from anywhere\n", first.scenario,
                  first.method, first.scout_camera, first.follower_camera);
  text += SummaryLine("found", fmt::format("{} of {}", off_m.size(), rows.size()), "");
  text += SummaryLine("went on along the path", fmt::format("{} of {}", arrived, rows.size()), "");
  if (off_m.empty()) return text;
  std::sort(off_m.begin(), off_m.end());
  std::sort(after_s.begin(), after_s.end());
  text +=
      SummaryLine("found within half a segment", fmt::format("{} of {}", within, rows.size()), "");
  text += SummaryLine("off along the path, median",
                      fmt::format("{:.3f} m", off_m[off_m.size() / 2]), "");
  text += SummaryLine("largest", fmt::format("{:.3f} m", off_m.back()), "");
  text +=
      SummaryLine("found after, median", fmt::format("{:.1f} s", after_s[after_s.size() / 2]), "");
  text += SummaryLine("latest", fmt::format("{:.1f} s", after_s.back()), "");
  return text;
}

// Writes one visit after the other, over all teachings.
std::string VisitTable(const std::vector<TrialRow>& rows) {
  int last = 0;
  for (const TrialRow& row : rows) last = std::max(last, row.visit);
  std::string text =
      fmt::format("{:>5}{:>9}{:>9}{:>9}{:>9}{:>7}{:>8}{:>11}{:>8}{:>9}\n", "visit", "arrived",
                  "end m", "mean m", "max m", "found", "B/m", "refreshed", "added", "dropped");
  for (int visit = 1; visit <= last; ++visit) {
    std::vector<TrialRow> of_visit;
    std::copy_if(rows.begin(), rows.end(), std::back_inserter(of_visit),
                 [&](const TrialRow& row) { return row.visit == visit; });
    if (of_visit.empty()) continue;
    const TrialSummary summary = Summarize(of_visit);
    int refreshed = 0;
    int added = 0;
    int dropped = 0;
    for (const TrialRow& row : of_visit) {
      if (!row.refreshed) continue;
      ++refreshed;
      added += row.refreshed->added;
      dropped += row.refreshed->dropped;
    }
    text +=
        fmt::format("{:>5}{:>9}{:>9.3f}{:>9.3f}{:>9.3f}{:>6.0f}%{:>8.0f}{:>11}{:>8}{:>9}\n", visit,
                    fmt::format("{}/{}", summary.arrived, summary.trials), summary.accuracy_m,
                    summary.mean_path_error_m, summary.max_path_error_m,
                    100.0 * summary.found_share, summary.bytes_per_m, refreshed, added, dropped);
  }
  return text;
}

// Writes a line for each cell. A robot that says that it is lost, or stands, harms nobody. One that
// says that it has arrived where it has not, or drives away, is wrong.
std::string MatrixTable(const std::vector<std::vector<TrialRow>>& cells) {
  std::string text = fmt::format("{:<40}{:>9}{:>11}{:>7}{:>12}{:>8}\n", "start, task, camera",
                                 "reached", "gave up", "wrong", "median m", "max m");
  for (const std::vector<TrialRow>& rows : cells) {
    std::vector<double> off_m;
    int wrong = 0;
    for (const TrialRow& row : rows) {
      if (row.arrived) off_m.push_back(row.verdict.final_error_m);
      wrong += row.state == "misplaced" || row.state == "strayed" ? 1 : 0;
    }
    std::sort(off_m.begin(), off_m.end());
    const auto reached = static_cast<int>(off_m.size());
    text += fmt::format("{:<40}{:>9}{:>11}{:>7}", ToText(*rows.front().cell),
                        fmt::format("{}/{}", reached, rows.size()),
                        static_cast<int>(rows.size()) - reached - wrong, wrong);
    text += off_m.empty()
                ? "\n"
                : fmt::format("{:>12.2f}{:>8.2f}\n", off_m[off_m.size() / 2], off_m.back());
  }
  return text;
}

std::string SummaryTable(const std::vector<TrialRow>& rows) {
  const bool set_down =
      std::any_of(rows.begin(), rows.end(), [](const TrialRow& row) { return row.set_down; });
  if (set_down) return FoundTable(rows);
  const TrialRow& first = rows.front();
  const TrialSummary summary = Summarize(rows);
  const std::optional<PaperFigures> paper = PaperFiguresFor(first);
  const auto meters = [](double value) { return fmt::format("{:.3f} m", value); };
  const auto beside = [&](double PaperFigures::*figure) {
    return paper ? fmt::format("{:.2f} m", (*paper).*figure) : std::string();
  };
  std::string text = fmt::format(
      "{}, method {}, taught by {}, followed by {}{}{}\n", first.scenario, first.method,
      first.scout_camera, first.follower_camera, first.same_robot ? " of the same robot" : "",
      first.flaw.empty() ? "" : ", flaw " + first.flaw);
  text += SummaryLine("", "ours", paper ? "the paper" : "");
  text += SummaryLine("accuracy (RMS at the end)", meters(summary.accuracy_m),
                      beside(&PaperFigures::accuracy_m));
  text += SummaryLine("repeatability", meters(summary.repeatability_m),
                      beside(&PaperFigures::repeatability_m));
  text += SummaryLine("largest final error", meters(summary.largest_final_error_m),
                      beside(&PaperFigures::largest_final_error_m));
  text += SummaryLine("mean distance from the path", meters(summary.mean_path_error_m), "");
  text += SummaryLine("nine tenths of the way within", meters(summary.p90_path_error_m), "");
  text += SummaryLine("largest distance from the path", meters(summary.max_path_error_m), "");
  text += SummaryLine("arrived", fmt::format("{} of {}", summary.arrived, summary.trials), "");
  text += SummaryLine("features found at hand-over",
                      fmt::format("{:.0f} %", 100.0 * summary.found_share), paper ? "85 %" : "");
  text += SummaryLine("segments", fmt::format("{:.1f}", summary.segments), "");
  text += SummaryLine("route", fmt::format("{:.0f} B/m", summary.bytes_per_m), "");
  text += SummaryLine("replay, CPU a frame", fmt::format("{:.2f} ms", summary.ms_per_frame), "");
  return text;
}

}  // namespace

std::string TrialTable(const std::vector<TrialRow>& rows) {
  if (rows.empty()) return "no trials\n";
  const auto cases = Cases(rows);
  std::string text;
  for (const std::vector<TrialRow>& each : cases) {
    if (cases.size() > 1) text += CaseName(each.front()) + "\n";
    text += RowTable(each);
    if (each.front().visit > 0) {
      text += '\n';
      text += VisitTable(each);
    }
    text += '\n';
  }
  if (cases.size() == 1) return text + SummaryTable(rows);
  text += rows.front().scenario + "\n";
  return text + (rows.front().cell ? MatrixTable(cases) : CaseTable(cases));
}

}  // namespace trailcast::trial
