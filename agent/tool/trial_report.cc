#include "agent/tool/trial_report.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <optional>

namespace trailcast::tool {
namespace {

// Chen & Birchfield 2009, Table I: ten trials each.
struct PaperFigures {
  const char* scenario;
  double accuracy_m;
  double repeatability_m;
  double largest_final_error_m;
};
constexpr PaperFigures kPaperTable[] = {{"indoor", 0.14, 0.08, 0.23}};

std::optional<PaperFigures> PaperFiguresFor(const std::string& scenario) {
  const auto* found =
      std::find_if(std::begin(kPaperTable), std::end(kPaperTable),
                   [&](const PaperFigures& row) { return scenario == row.scenario; });
  if (found == std::end(kPaperTable)) return std::nullopt;
  return *found;
}

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

std::string CsvText(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + '"';
}

std::string SummaryLine(const char* what, const std::string& ours, const std::string& paper) {
  return fmt::format("  {:<32}{:>12}{:>12}\n", what, ours, paper);
}

}  // namespace

TrialSummary Summarize(const std::vector<TrialRow>& rows) {
  TrialSummary summary;
  if (rows.empty()) return summary;
  // The ends differ by centimetres from trial to trial (each teaches anew), so positions are
  // compared as offsets from the end that was taught.
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
  summary.max_path_error_m =
      Largest(rows, [](const TrialRow& row) { return row.verdict.max_path_error_m; });
  summary.found_share = Mean(rows, [](const TrialRow& row) { return row.found_share; });
  summary.segments = Mean(rows, [](const TrialRow& row) { return row.segments; });
  summary.bytes_per_m = Mean(rows, [](const TrialRow& row) { return row.bytes_per_m; });
  summary.ms_per_frame = Mean(rows, [](const TrialRow& row) { return row.ms_per_frame; });
  return summary;
}

std::string TrialCsvHeader() {
  return "scenario,method,scout_camera,follower_camera,trial,seed,arrived,final_error_m,final_x_m,"
         "final_y_m,end_x_m,end_y_m,mean_path_error_m,max_path_error_m,found_share,segments,"
         "bytes_per_m,ms_per_frame,state,taught_m,driven_m,worst_path_error_m,frames,hand_overs,"
         "reason";
}

std::string TrialCsvLine(const TrialRow& row) {
  const Verdict& verdict = row.verdict;
  return fmt::format(
      "{},{},{},{},{},{},{},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{},{:.1f},"
      "{:.3f},{},{:.3f},{:.3f},{:.4f},{},{},{}",
      CsvText(row.scenario), row.method, CsvText(row.scout_camera), CsvText(row.follower_camera),
      row.trial, row.seed, row.arrived ? 1 : 0, verdict.final_error_m, verdict.final_m.x(),
      verdict.final_m.y(), row.end_m.x(), row.end_m.y(), verdict.mean_path_error_m,
      verdict.max_path_error_m, row.found_share, row.segments, row.bytes_per_m, row.ms_per_frame,
      row.state, row.taught_m, verdict.driven_m, verdict.worst_path_error_m, row.frames,
      row.hand_overs, CsvText(row.reason));
}

Result<void> WriteTrialCsv(const std::vector<TrialRow>& rows, const std::filesystem::path& file) {
  std::ofstream out(file, std::ios::trunc);
  out << TrialCsvHeader() << '\n';
  for (const TrialRow& row : rows) out << TrialCsvLine(row) << '\n';
  out.close();
  if (!out) {
    return Fail(ErrorCode::kUnavailable,
                "cannot write {}: does its folder exist, is the disk full?", file.string());
  }
  return {};
}

std::string TrialTable(const std::vector<TrialRow>& rows) {
  if (rows.empty()) return "no trials\n";
  std::string text =
      fmt::format("{:>5}{:>8} {:<10}{:>9}{:>9}{:>9}{:>7}{:>9}{:>8}{:>10}\n", "trial", "seed",
                  "state", "end m", "mean m", "max m", "found", "segments", "B/m", "ms/frame");
  for (const TrialRow& row : rows) {
    text += fmt::format("{:>5}{:>8} {:<10}{:>9.3f}{:>9.3f}{:>9.3f}{:>6.0f}%{:>9}{:>8.0f}{:>10.2f}",
                        row.trial, row.seed, row.state, row.verdict.final_error_m,
                        row.verdict.mean_path_error_m, row.verdict.max_path_error_m,
                        100.0 * row.found_share, row.segments, row.bytes_per_m, row.ms_per_frame);
    text += row.reason.empty() ? "\n" : fmt::format("  {}\n", row.reason);
  }
  const TrialRow& first = rows.front();
  const TrialSummary summary = Summarize(rows);
  const std::optional<PaperFigures> paper = PaperFiguresFor(first.scenario);
  const auto meters = [](double value) { return fmt::format("{:.3f} m", value); };
  const auto beside = [&](double PaperFigures::*figure) {
    return paper ? fmt::format("{:.2f} m", (*paper).*figure) : std::string();
  };
  text += fmt::format("\n{}, method {}, taught by {}, followed by {}\n", first.scenario,
                      first.method, first.scout_camera, first.follower_camera);
  text += SummaryLine("", "ours", paper ? "the paper" : "");
  text += SummaryLine("accuracy (RMS at the end)", meters(summary.accuracy_m),
                      beside(&PaperFigures::accuracy_m));
  text += SummaryLine("repeatability", meters(summary.repeatability_m),
                      beside(&PaperFigures::repeatability_m));
  text += SummaryLine("largest final error", meters(summary.largest_final_error_m),
                      beside(&PaperFigures::largest_final_error_m));
  text += SummaryLine("mean distance from the path", meters(summary.mean_path_error_m), "");
  text += SummaryLine("largest distance from the path", meters(summary.max_path_error_m), "");
  text += SummaryLine("arrived", fmt::format("{} of {}", summary.arrived, summary.trials), "");
  text += SummaryLine("features found at hand-over",
                      fmt::format("{:.0f} %", 100.0 * summary.found_share), paper ? "85 %" : "");
  text += SummaryLine("segments", fmt::format("{:.1f}", summary.segments), "");
  text += SummaryLine("route", fmt::format("{:.0f} B/m", summary.bytes_per_m), "");
  text += SummaryLine("replay, CPU a frame", fmt::format("{:.2f} ms", summary.ms_per_frame), "");
  return text;
}

}  // namespace trailcast::tool
