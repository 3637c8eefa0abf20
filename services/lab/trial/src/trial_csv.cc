#include "services/lab/trial/trial_csv.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <utility>

#include "services/base/csv_line.h"
#include "services/base/text_file.h"

namespace trailcast::trial {
namespace {

TrialRow RowOf(CsvLine& line) {
  TrialRow row;
  row.scenario = line.Text("scenario");
  row.method = line.Text("method");
  row.scout_camera = line.Text("scout_camera");
  row.follower_camera = line.Text("follower_camera");
  line.Read("trial", row.trial);
  line.Read("seed", row.seed);
  row.arrived = line.Text("arrived") == "1";
  PathVerdict& verdict = row.verdict;
  line.Read("final_error_m", verdict.final_error_m);
  line.Read("final_x_m", verdict.final_m.x());
  line.Read("final_y_m", verdict.final_m.y());
  line.Read("end_x_m", row.end_m.x());
  line.Read("end_y_m", row.end_m.y());
  line.Read("mean_path_error_m", verdict.mean_path_error_m);
  line.Read("max_path_error_m", verdict.max_path_error_m);
  line.Read("found_share", row.found_share);
  line.Read("segments", row.segments);
  line.Read("bytes_per_m", row.bytes_per_m);
  line.Read("ms_per_frame", row.ms_per_frame);
  row.state = line.Text("state");
  line.Read("taught_m", row.taught_m);
  line.Read("driven_m", verdict.driven_m);
  line.Read("worst_path_error_m", verdict.worst_path_error_m);
  line.Read("frames", row.frames);
  line.Read("hand_overs", row.hand_overs);
  line.Read("push_m", row.push_m);
  if (!line.Text("after_push_m").empty()) {
    line.Read("after_push_m", verdict.after_push_m.emplace());
  }
  line.Read("p90_path_error_m", verdict.p90_path_error_m);
  line.ReadAll("lap_ends_m", row.lap_ends_m);
  row.same_robot = line.Text("same_robot") == "1";
  row.flaw = line.Text("flaw");
  row.reason = line.Text("reason");
  return row;
}

}  // namespace

std::string TrialCsvHeader() {
  return "scenario,method,scout_camera,follower_camera,trial,seed,arrived,final_error_m,final_x_m,"
         "final_y_m,end_x_m,end_y_m,mean_path_error_m,max_path_error_m,found_share,segments,"
         "bytes_per_m,ms_per_frame,state,taught_m,driven_m,worst_path_error_m,frames,hand_overs,"
         "push_m,after_push_m,p90_path_error_m,lap_ends_m,same_robot,flaw,reason";
}

std::string TrialCsvLine(const TrialRow& row) {
  const PathVerdict& verdict = row.verdict;
  return fmt::format(
      "{},{},{},{},{},{},{},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{},{:.1f},"
      "{:.3f},{},{:.3f},{:.3f},{:.4f},{},{},{:.1f},{},{:.4f},{:.4f},{},{},{}",
      CsvText(row.scenario), row.method, CsvText(row.scout_camera), CsvText(row.follower_camera),
      row.trial, row.seed, row.arrived ? 1 : 0, verdict.final_error_m, verdict.final_m.x(),
      verdict.final_m.y(), row.end_m.x(), row.end_m.y(), verdict.mean_path_error_m,
      verdict.max_path_error_m, row.found_share, row.segments, row.bytes_per_m, row.ms_per_frame,
      row.state, row.taught_m, verdict.driven_m, verdict.worst_path_error_m, row.frames,
      row.hand_overs, row.push_m,
      verdict.after_push_m ? fmt::format("{:.4f}", *verdict.after_push_m) : "",
      verdict.p90_path_error_m, fmt::join(row.lap_ends_m, " "), row.same_robot ? 1 : 0, row.flaw,
      CsvText(row.reason));
}

Result<void> WriteTrialCsv(const std::vector<TrialRow>& rows, const std::filesystem::path& file) {
  std::string text = TrialCsvHeader() + '\n';
  for (const TrialRow& row : rows) text += TrialCsvLine(row) + '\n';
  return WriteTextFile(file, text);
}

Result<std::vector<TrialRow>> ReadTrialCsv(const std::filesystem::path& file) {
  std::vector<TrialRow> rows;
  return ReadCsvTable(file, TrialCsvHeader(), "a table of trials",
                      [&](CsvLine& line) { rows.push_back(RowOf(line)); })
      .map([&] { return std::move(rows); });
}

}  // namespace trailcast::trial
