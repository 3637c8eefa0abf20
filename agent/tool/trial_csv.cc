#include "agent/tool/trial_csv.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <charconv>
#include <fstream>
#include <map>
#include <optional>
#include <sstream>

#include "agent/text_file.h"

namespace trailcast::tool {
namespace {

std::string CsvText(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + '"';
}

// The cells of one line; nothing where a quote is not closed.
std::optional<std::vector<std::string>> Cells(const std::string& line) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (quoted && c == '"' && i + 1 < line.size() && line[i + 1] == '"') {
      cells.back() += '"';
      ++i;
    } else if (c == '"') {
      quoted = !quoted;
    } else if (c == ',' && !quoted) {
      cells.emplace_back();
    } else if (c != '\r') {
      cells.back() += c;
    }
  }
  if (quoted) return std::nullopt;
  return cells;
}

// One line by the names of its columns. The first cell that is not what it should be is kept as
// the line's trouble.
class Line {
 public:
  Line(const std::vector<std::string>& names, const std::vector<std::string>& cells) {
    for (std::size_t i = 0; i < names.size() && i < cells.size(); ++i) cells_[names[i]] = cells[i];
  }

  [[nodiscard]] const std::string& Text(const std::string& name) { return cells_[name]; }
  template <typename Number>
  void Read(const std::string& name, Number& number) {
    Parse(name, cells_[name], number);
  }
  // Numbers with blanks between.
  void ReadAll(const std::string& name, std::vector<double>& numbers) {
    std::istringstream words(cells_[name]);
    for (std::string word; words >> word;) Parse(name, word, numbers.emplace_back());
  }
  [[nodiscard]] const std::string& trouble() const { return trouble_; }

 private:
  template <typename Number>
  void Parse(const std::string& name, const std::string& text, Number& number) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if ((error != std::errc() || end != text.data() + text.size()) && trouble_.empty()) {
      trouble_ = fmt::format("{} is '{}', expected a number", name, text);
    }
  }

  std::map<std::string, std::string> cells_;
  std::string trouble_;
};

TrialRow RowOf(Line& line) {
  TrialRow row;
  row.scenario = line.Text("scenario");
  row.method = line.Text("method");
  row.scout_camera = line.Text("scout_camera");
  row.follower_camera = line.Text("follower_camera");
  line.Read("trial", row.trial);
  line.Read("seed", row.seed);
  row.arrived = line.Text("arrived") == "1";
  Verdict& verdict = row.verdict;
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
  row.reason = line.Text("reason");
  return row;
}

}  // namespace

std::string TrialCsvHeader() {
  return "scenario,method,scout_camera,follower_camera,trial,seed,arrived,final_error_m,final_x_m,"
         "final_y_m,end_x_m,end_y_m,mean_path_error_m,max_path_error_m,found_share,segments,"
         "bytes_per_m,ms_per_frame,state,taught_m,driven_m,worst_path_error_m,frames,hand_overs,"
         "push_m,after_push_m,p90_path_error_m,lap_ends_m,reason";
}

std::string TrialCsvLine(const TrialRow& row) {
  const Verdict& verdict = row.verdict;
  return fmt::format(
      "{},{},{},{},{},{},{},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{},{:.1f},"
      "{:.3f},{},{:.3f},{:.3f},{:.4f},{},{},{:.1f},{},{:.4f},{:.4f},{}",
      CsvText(row.scenario), row.method, CsvText(row.scout_camera), CsvText(row.follower_camera),
      row.trial, row.seed, row.arrived ? 1 : 0, verdict.final_error_m, verdict.final_m.x(),
      verdict.final_m.y(), row.end_m.x(), row.end_m.y(), verdict.mean_path_error_m,
      verdict.max_path_error_m, row.found_share, row.segments, row.bytes_per_m, row.ms_per_frame,
      row.state, row.taught_m, verdict.driven_m, verdict.worst_path_error_m, row.frames,
      row.hand_overs, row.push_m,
      verdict.after_push_m ? fmt::format("{:.4f}", *verdict.after_push_m) : "",
      verdict.p90_path_error_m, fmt::join(row.lap_ends_m, " "), CsvText(row.reason));
}

Result<void> WriteTrialCsv(const std::vector<TrialRow>& rows, const std::filesystem::path& file) {
  std::string text = TrialCsvHeader() + '\n';
  for (const TrialRow& row : rows) text += TrialCsvLine(row) + '\n';
  return agent::WriteTextFile(file, text);
}

Result<std::vector<TrialRow>> ReadTrialCsv(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::string text;
  if (!std::getline(in, text) || text != TrialCsvHeader()) {
    return Fail(ErrorCode::kInvalidArgument,
                "{} is not a table of trials: expected its first line to be {}", file.string(),
                TrialCsvHeader());
  }
  const std::vector<std::string> names = *Cells(text);
  std::vector<TrialRow> rows;
  for (int number = 2; std::getline(in, text); ++number) {
    const auto cells = Cells(text);
    if (!cells || cells->size() != names.size()) {
      return Fail(ErrorCode::kInvalidArgument, "{}, line {}: expected {} cells", file.string(),
                  number, names.size());
    }
    Line line(names, *cells);
    rows.push_back(RowOf(line));
    if (!line.trouble().empty()) {
      return Fail(ErrorCode::kInvalidArgument, "{}, line {}: {}", file.string(), number,
                  line.trouble());
    }
  }
  return rows;
}

}  // namespace trailcast::tool
