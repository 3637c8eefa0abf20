#include "services/lab/trial/judge/recording_report.h"

#include <fmt/format.h>

#include <algorithm>

namespace trailcast::trial {
namespace {

std::optional<double> Share(int part, int whole) {
  if (whole == 0) return std::nullopt;
  return static_cast<double>(part) / whole;
}

std::string Cell(const std::optional<double>& share) {
  return share ? fmt::format("{:.3f}", *share) : "-";
}

std::string FoundCell(const Verdict& verdict) {
  if (verdict.offs == 0) return "-";
  return fmt::format("{} of {}", verdict.found_in_time, verdict.offs);
}

}  // namespace

RecordingShares SharesOf(const Verdict& v) {
  return {Share(v.following, v.frames),      Share(v.lost, v.frames),
          Share(v.right, v.aligned),         Share(v.wrong, v.aligned),
          Share(v.side_right, v.sided),      Share(v.correction_right, v.corrected),
          Share(v.steered_alike, v.steered), Share(v.found_in_time, v.offs)};
}

std::string RecordingTable(const std::vector<RecordingRow>& rows) {
  std::size_t width = 10;
  const auto name = [](const RecordingRow& row) { return row.replay + " on " + row.teach; };
  for (const RecordingRow& row : rows) width = std::max(width, name(row).size());
  std::string text =
      fmt::format("{:<9} {:<{}} {:<12} {:>9} {:>6} {:>6} {:>6} {:>11} {:>6} {:>7} {:>8}  {}\n",
                  "kind", "replay", width, "disturbed", "following", "right", "wrong", "lost",
                  "found again", "side", "correct", "steering", "ends");
  for (const RecordingRow& row : rows) {
    const RecordingShares shares = SharesOf(row.verdict);
    text +=
        fmt::format("{:<9} {:<{}} {:<12} {:>9} {:>6} {:>6} {:>6} {:>11} {:>6} {:>7} {:>8}  {}\n",
                    ToString(row.kind), name(row), width, row.disturbance, Cell(shares.following),
                    Cell(shares.right), Cell(shares.wrong), Cell(shares.lost),
                    FoundCell(row.verdict), Cell(shares.side), Cell(shares.correction),
                    Cell(shares.steering), row.error.empty() ? row.state : row.error);
  }
  std::string told;
  for (const RecordingRow& row : rows) {
    std::string visits;
    for (const std::string& visit : row.visits) visits += visit + '\n';
    if (visits != told) text += visits;
    told = std::move(visits);
    for (const std::string& each : row.news) text += each + '\n';
  }
  return text;
}

}  // namespace trailcast::trial
