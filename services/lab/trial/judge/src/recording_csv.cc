#include "services/lab/trial/judge/recording_csv.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <fstream>
#include <utility>

#include "services/base/csv_line.h"
#include "services/base/text_file.h"
#include "services/lab/trial/judge/recording_report.h"

namespace trailcast::trial {
namespace {

// The counts by their columns' names.
constexpr std::pair<const char*, int Verdict::*> kCounts[] = {
    {"frames", &Verdict::frames},       {"following", &Verdict::following},
    {"lost", &Verdict::lost},           {"aligned", &Verdict::aligned},
    {"right", &Verdict::right},         {"wrong", &Verdict::wrong},
    {"sided", &Verdict::sided},         {"side_right", &Verdict::side_right},
    {"corrected", &Verdict::corrected}, {"correction_right", &Verdict::correction_right},
    {"steered", &Verdict::steered},     {"steered_alike", &Verdict::steered_alike},
    {"offs", &Verdict::offs},           {"found_in_time", &Verdict::found_in_time},
};

std::string CsvCell(const std::optional<double>& share) {
  return share ? fmt::format("{:.4f}", *share) : "";
}

RecordingRow RowOf(CsvLine& line) {
  RecordingRow row;
  row.set = line.Text("set");
  for (const PairKind kind : {PairKind::kIdentity, PairKind::kRight, PairKind::kWrong}) {
    if (line.Text("kind") == ToString(kind)) row.kind = kind;
  }
  row.teach = line.Text("teach");
  row.replay = line.Text("replay");
  row.disturbance = line.Text("disturb");
  row.method = line.Text("method");
  row.verdict.arrived = line.Text("arrived") == "1";
  row.state = line.Text("state");
  row.error = line.Text("error");
  line.Read("segments", row.segments);
  for (const auto& [name, count] : kCounts) line.Read(name, row.verdict.*count);
  line.ReadAll("found_s", row.verdict.found_s);
  line.Read("ms_per_frame", row.ms_per_frame);
  return row;
}

}  // namespace

std::string RecordingCsvHeader() {
  std::string header =
      "set,kind,teach,replay,disturb,method,following_share,right_share,wrong_share,lost_share,"
      "arrived,side_share,correction_share,steering_share,found_share,state,error,segments";
  for (const auto& [name, count] : kCounts) header += std::string(",") + name;
  return header + ",found_s,ms_per_frame";
}

std::string RecordingCsvLine(const RecordingRow& row) {
  const Verdict& verdict = row.verdict;
  const RecordingShares shares = SharesOf(verdict);
  std::string line = fmt::format(
      "{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}", CsvText(row.set), ToString(row.kind),
      CsvText(row.teach), CsvText(row.replay), CsvText(row.disturbance), row.method,
      CsvCell(shares.following), CsvCell(shares.right), CsvCell(shares.wrong), CsvCell(shares.lost),
      verdict.arrived ? 1 : 0, CsvCell(shares.side), CsvCell(shares.correction),
      CsvCell(shares.steering), CsvCell(shares.found), row.state, CsvText(row.error), row.segments);
  for (const auto& [name, count] : kCounts) line += fmt::format(",{}", verdict.*count);
  return line + fmt::format(",{:.3f},{:.3f}", fmt::join(verdict.found_s, " "), row.ms_per_frame);
}

Result<void> WriteRecordingCsv(const std::vector<RecordingRow>& rows,
                               const std::filesystem::path& file) {
  std::string text = RecordingCsvHeader() + '\n';
  for (const RecordingRow& row : rows) text += RecordingCsvLine(row) + '\n';
  return WriteTextFile(file, text);
}

bool IsRecordingCsv(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::string text;
  return std::getline(in, text) && text == RecordingCsvHeader();
}

Result<std::vector<RecordingRow>> ReadRecordingCsv(const std::filesystem::path& file) {
  std::vector<RecordingRow> rows;
  return ReadCsvTable(file, RecordingCsvHeader(), "a table of judged recordings",
                      [&](CsvLine& line) { rows.push_back(RowOf(line)); })
      .map([&] { return std::move(rows); });
}

}  // namespace trailcast::trial
