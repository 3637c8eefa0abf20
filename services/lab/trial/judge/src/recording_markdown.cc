#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "services/lab/trial/judge/recording_report.h"

namespace trailcast::trial {
namespace {

using Rows = std::vector<RecordingRow>;
using ShareOf = std::optional<double> RecordingShares::*;

// One measure of recordings: the replays that it covers, and its value for them.
struct Measure {
  std::string name;
  std::string goal;
  std::function<bool(const RecordingRow&)> about;
  std::function<std::string(const Rows&)> value;
};

std::vector<double> Values(const Rows& rows, ShareOf share) {
  std::vector<double> values;
  for (const RecordingRow& row : rows) {
    if (const auto value = SharesOf(row.verdict).*share) values.push_back(*value);
  }
  return values;
}

std::string LeastAndMean(const Rows& rows, ShareOf share) {
  const std::vector<double> values = Values(rows, share);
  if (values.empty()) return "";
  double sum = 0.0;
  for (const double value : values) sum += value;
  return fmt::format("{:.3f} ({:.3f})", *std::min_element(values.begin(), values.end()),
                     sum / static_cast<double>(values.size()));
}

std::string Most(const Rows& rows, ShareOf share) {
  const std::vector<double> values = Values(rows, share);
  return values.empty() ? ""
                        : fmt::format("{:.3f}", *std::max_element(values.begin(), values.end()));
}

Verdict Sum(const Rows& rows) {
  Verdict sum;
  for (const RecordingRow& row : rows) sum.Add(row.verdict);
  return sum;
}

// Returns the share over all frames of all replays together.
std::string Pooled(const Rows& rows, ShareOf share) {
  const auto value = SharesOf(Sum(rows)).*share;
  return value ? fmt::format("{:.3f}", *value) : "";
}

std::string RightAndWrong(const Rows& rows) {
  return fmt::format("{}, {}", LeastAndMean(rows, &RecordingShares::right),
                     Most(rows, &RecordingShares::wrong));
}

std::string InOtherPlaces(const Rows& rows) {
  if (rows.empty()) return "";
  const auto arrived = std::count_if(rows.begin(), rows.end(),
                                     [](const RecordingRow& row) { return row.verdict.arrived; });
  return fmt::format("{}; {} of {}", Pooled(rows, &RecordingShares::following), arrived,
                     rows.size());
}

bool IsPlain(const RecordingRow& row, PairKind kind) {
  return row.kind == kind && row.disturbance == "none";
}

bool HasCuts(const RecordingRow& row) {
  return row.disturbance.find("jump") != std::string::npos ||
         row.disturbance.find("skip") != std::string::npos;
}

std::vector<Measure> PlainMeasures() {
  const auto right = [](const RecordingRow& row) { return IsPlain(row, PairKind::kRight); };
  return {
      {"what was taught, replayed: FOLLOWING, least (mean)", "1.000",
       [](const RecordingRow& row) { return IsPlain(row, PairKind::kIdentity); },
       [](const Rows& rows) { return LeastAndMean(rows, &RecordingShares::following); }},
      {"right route: FOLLOWING within 5 %, least (mean)", "0.90 (0.95)", right,
       [](const Rows& rows) { return LeastAndMean(rows, &RecordingShares::right); }},
      {"right route: FOLLOWING at a wrong place, most", "0.01", right,
       [](const Rows& rows) { return Most(rows, &RecordingShares::wrong); }},
      {"another place: FOLLOWING; replays that ARRIVED", "0.001; 0",
       [](const RecordingRow& row) { return row.kind == PairKind::kWrong; }, InOtherPlaces},
      {"turn to the right side, where there is one", "0.95", right,
       [](const Rows& rows) { return Pooled(rows, &RecordingShares::side); }},
      {"the same, less what the route itself asks for there", "", right,
       [](const Rows& rows) { return Pooled(rows, &RecordingShares::correction); }},
      {"turn as the driver steered", "0.90", right,
       [](const Rows& rows) { return Pooled(rows, &RecordingShares::steering); }},
      {"found again after a cut, within 2 s", "0.95", HasCuts,
       [](const Rows& rows) { return Pooled(rows, &RecordingShares::found); }},
      {"replays ended by an error", "0", [](const RecordingRow&) { return true; },
       [](const Rows& rows) {
         return fmt::format(
             "{} of {}",
             std::count_if(rows.begin(), rows.end(),
                           [](const RecordingRow& row) { return !row.error.empty(); }),
             rows.size());
       }},
  };
}

// Returns the measures above, and one for each disturbance in the rows.
std::vector<Measure> Measures(const Rows& rows) {
  std::vector<Measure> measures = PlainMeasures();
  std::vector<std::string> told{"none"};
  for (const RecordingRow& row : rows) {
    if (std::find(told.begin(), told.end(), row.disturbance) != told.end()) continue;
    told.push_back(row.disturbance);
    const bool camera = row.disturbance.starts_with("camera");
    measures.push_back(
        {fmt::format("`{}`: within 5 %, least (mean), wrong place, most", row.disturbance),
         camera ? "0.90, 0.02" : "",
         [name = row.disturbance](const RecordingRow& each) {
           return each.kind == PairKind::kRight && each.disturbance == name;
         },
         RightAndWrong});
  }
  return measures;
}

Rows Select(const Rows& rows, const std::function<bool(const RecordingRow&)>& about) {
  Rows selected;
  std::copy_if(rows.begin(), rows.end(), std::back_inserter(selected), about);
  return selected;
}

std::vector<std::string> SetsOf(const Rows& rows) {
  std::vector<std::string> sets;
  for (const RecordingRow& row : rows) {
    if (std::find(sets.begin(), sets.end(), row.set) == sets.end()) sets.push_back(row.set);
  }
  return sets;
}

std::string Line(const std::vector<std::string>& cells) {
  std::string line = "|";
  for (const std::string& cell : cells) line += " " + cell + " |";
  return line + '\n';
}

std::string MarkdownCell(const std::optional<double>& share) {
  return share ? fmt::format("{:.3f}", *share) : "";
}

std::string LineOf(const RecordingRow& row) {
  const RecordingShares shares = SharesOf(row.verdict);
  const Verdict& verdict = row.verdict;
  return Line({row.set, ToString(row.kind), row.replay, row.teach, row.disturbance,
               MarkdownCell(shares.following), MarkdownCell(shares.right),
               MarkdownCell(shares.wrong), MarkdownCell(shares.lost),
               verdict.offs > 0 ? fmt::format("{} of {}", verdict.found_in_time, verdict.offs) : "",
               MarkdownCell(shares.side), MarkdownCell(shares.correction),
               MarkdownCell(shares.steering), fmt::format("{:.2f}", row.ms_per_frame),
               row.error.empty() ? row.state : row.error});
}

}  // namespace

std::string RecordingMarkdown(const Rows& rows) {
  const std::vector<std::string> sets = SetsOf(rows);
  std::vector<std::string> head{"measure", "goal"};
  for (const std::string& set : sets) head.push_back(set.empty() ? "all" : set);
  std::string text = Line(head) + Line(std::vector<std::string>(head.size(), "---"));
  for (const Measure& measure : Measures(rows)) {
    const Rows about = Select(rows, measure.about);
    std::vector<std::string> cells{measure.name, measure.goal};
    for (const std::string& set : sets) {
      const Rows of_set = Select(about, [&](const RecordingRow& row) { return row.set == set; });
      cells.push_back(of_set.empty() ? "" : measure.value(of_set));
    }
    text += Line(cells);
  }
  const std::vector<std::string> columns{
      "set",        "kind",       "replay",     "on",       "disturbed",
      "FOLLOWING",  "within 5 %", "wrong",      "LOST",     "found again in 2 s",
      "side right", "correction", "as steered", "ms/frame", "ends"};
  text += '\n' + Line(columns) + Line(std::vector<std::string>(columns.size(), "---"));
  for (const RecordingRow& row : rows) text += LineOf(row);
  return text;
}

}  // namespace trailcast::trial
