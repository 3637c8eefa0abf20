#include "services/lab/demo/demo_report.h"

#include <cstdlib>
#include <fstream>
#include <utility>

namespace trailcast::demo {
namespace {

using Report = std::map<std::string, std::string>;

std::string Value(const Report& report, const std::string& key) {
  const auto found = report.find(key);
  return found == report.end() ? "-" : found->second;
}

std::string Percent(const std::string& share) {
  char* end = nullptr;
  const double value = std::strtod(share.c_str(), &end);
  return end == share.c_str() ? share : fmt::format("{:.0f} %", 100.0 * value);
}

void JudgeScout(const Report& report, DemoRow& row) {
  row.arrived = Value(report, "unreceipted") == "0";
  if (!row.arrived) row.why_not = "not all it taught was confirmed by the server";
}

void JudgeFollower(const Report& report, const TruthFile& truth, const trial::TruePath& taught,
                   DemoRow& row) {
  if (taught.empty()) {
    row.why_not = "nothing was taught";
    return;
  }
  trial::PathJudge judge(taught);
  for (const Eigen::Vector2d& position_m : truth.positions_m) judge.Observe(position_m);
  row.verdict = judge.verdict();
  row.found_share = Percent(Value(report, "found_share"));
  if (Value(report, "arrived") != "1") {
    row.why_not = fmt::format("{}: {}", Value(report, "state"), Value(report, "reason"));
  } else if (row.verdict.final_error_m > trial::kArrivalRadius_m) {
    row.why_not =
        fmt::format("says it arrived, but {:.1f} m from the end", row.verdict.final_error_m);
  } else if (row.verdict.worst_path_error_m > trial::kStrayLimit_m) {
    row.why_not = fmt::format("was {:.1f} m off the path", row.verdict.worst_path_error_m);
  }
  row.arrived = row.why_not.empty();
}

DemoRow JudgeRobot(const DemoRobot& robot, const std::optional<ExitStatus>& ended,
                   const trial::TruePath& taught) {
  DemoRow row;
  row.robot = robot;
  const auto report = ReadReport(robot.report);
  const auto truth = ReadTruth(robot.truth);
  if (!report || !truth || truth->positions_m.empty()) {
    row.why_not = ended ? fmt::format("its process {}", ToString(*ended)) : "had not ended";
    return row;
  }
  row.path = PathOf(*truth);
  row.duration_s = truth->duration_s;
  row.segments = Value(*report, "segments");
  row.bytes_per_m = Value(*report, "bytes_per_m");
  if (robot.is_scout()) {
    JudgeScout(*report, row);
  } else {
    JudgeFollower(*report, *truth, taught, row);
  }
  return row;
}

}  // namespace

Result<TruthFile> ReadTruth(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::string line;
  if (!std::getline(in, line) || line.rfind("t_s,x_m,y_m", 0) != 0) {
    return Fail(ErrorCode::kNotFound, "{} is no file of true poses: expected t_s,x_m,y_m,...",
                file.string());
  }
  TruthFile truth;
  std::optional<double> first_s;
  while (std::getline(in, line)) {
    const char* at = line.c_str();
    double numbers[3];  // t, x, y
    for (double& number : numbers) {
      char* end = nullptr;
      number = std::strtod(at, &end);
      if (end == at) {
        return Fail(ErrorCode::kCorrupt, "{} line {}: expected three numbers, got '{}'",
                    file.string(), truth.positions_m.size() + 2, line);
      }
      at = *end == ',' ? end + 1 : end;
    }
    if (!first_s) first_s = numbers[0];
    truth.duration_s = numbers[0] - *first_s;
    truth.positions_m.emplace_back(numbers[1], numbers[2]);
  }
  return truth;
}

trial::TruePath PathOf(const TruthFile& truth) {
  trial::TruePath path;
  for (const Eigen::Vector2d& position_m : truth.positions_m) path.Add(position_m);
  return path;
}

Result<Report> ReadReport(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in) return Fail(ErrorCode::kNotFound, "{} is not there", file.string());
  Report report;
  for (std::string line; std::getline(in, line);) {
    const std::size_t equals = line.find('=');
    if (equals != std::string::npos) report[line.substr(0, equals)] = line.substr(equals + 1);
  }
  return report;
}

std::vector<DemoRow> JudgeDemo(const std::vector<DemoRobot>& robots,
                               const std::vector<std::optional<ExitStatus>>& ended) {
  std::vector<DemoRow> rows;
  for (std::size_t i = 0; i < robots.size(); ++i) {
    const trial::TruePath taught = rows.empty() ? trial::TruePath() : rows.front().path;
    rows.push_back(JudgeRobot(robots[i], ended[i], taught));
  }
  return rows;
}

std::string DemoTable(const std::vector<DemoRow>& rows) {
  std::string text = fmt::format("{:<11} {:<14} {:<8} {:>7} {:>8} {:>9} {:>6} {:>9} {:>6} {:>7}\n",
                                 "robot", "camera", "result", "end m", "mean m", "largest m",
                                 "found", "segments", "B/m", "drive s");
  for (const DemoRow& row : rows) {
    const auto meters = [&](double value) {
      return row.robot.is_scout() || row.path.empty() ? std::string("-")
                                                      : fmt::format("{:.3f}", value);
    };
    const char* result = row.arrived ? (row.robot.is_scout() ? "taught" : "arrived") : "FAILED";
    text += fmt::format("{:<11} {:<14} {:<8} {:>7} {:>8} {:>9} {:>6} {:>9} {:>6} {:>7.1f}\n",
                        row.robot.name, row.robot.camera, result, meters(row.verdict.final_error_m),
                        meters(row.verdict.mean_path_error_m), meters(row.verdict.max_path_error_m),
                        row.found_share, row.segments, row.bytes_per_m, row.duration_s);
  }
  for (const DemoRow& row : rows) {
    if (!row.arrived) text += fmt::format("{} did not arrive: {}\n", row.robot.name, row.why_not);
  }
  return text;
}

std::vector<plot::PlottedPath> DemoPaths(const std::vector<DemoRow>& rows) {
  std::vector<plot::PlottedPath> paths;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const DemoRow& row = rows[i];
    const std::string label =
        row.robot.is_scout()
            ? fmt::format("{} ({}): taught", row.robot.name, row.robot.camera)
            : fmt::format("{} ({}): {}, {:.2f} m from the end", row.robot.name, row.robot.camera,
                          row.arrived ? "arrived" : "did not arrive", row.verdict.final_error_m);
    paths.push_back(
        {label, plot::PathColor(i), row.path.points_m(), row.robot.is_scout(), !row.arrived});
  }
  return paths;
}

}  // namespace trailcast::demo
