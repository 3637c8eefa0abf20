#include "agent/odometry_file.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>

namespace trailcast::agent {
namespace {

constexpr std::string_view kHeader = "t_s,x_m,y_m,heading_rad";

// The first four numbers of a line, or nothing if there are fewer or they are not finite.
std::optional<std::array<double, 4>> ParseLine(std::string_view line) {
  std::array<double, 4> values{};
  const char* at = line.data();
  const char* const end = at + line.size();
  for (std::size_t i = 0; i < values.size(); ++i) {
    while (at != end && *at == ' ') ++at;
    const auto [next, error] = std::from_chars(at, end, values[i]);
    if (error != std::errc{} || !std::isfinite(values[i])) return std::nullopt;
    at = next;
    const bool last = i + 1 == values.size();
    if (last ? at != end && *at != ',' && *at != ' ' : at == end || *at != ',') return std::nullopt;
    if (!last) ++at;
  }
  return values;
}

void TrimLine(std::string& line) {
  if (!line.empty() && line.back() == '\r') line.pop_back();
}

}  // namespace

Result<OdometryFile> OdometryFile::Read(const std::filesystem::path& file) {
  std::ifstream stream(file);
  if (!stream) {
    return Fail(ErrorCode::kNotFound, "cannot read the odometry file {}", file.string());
  }
  std::string line;
  std::getline(stream, line);
  TrimLine(line);
  if (line.rfind(kHeader, 0) != 0) {
    return Fail(ErrorCode::kInvalidArgument, "{}, line 1: expected the header '{}'", file.string(),
                kHeader);
  }
  std::vector<Row> rows;
  for (int number = 2; std::getline(stream, line); ++number) {
    TrimLine(line);
    if (line.empty()) continue;
    const auto values = ParseLine(line);
    if (!values) {
      return Fail(ErrorCode::kInvalidArgument, "{}, line {}: expected four numbers '{}'",
                  file.string(), number, kHeader);
    }
    const auto& [t_s, x_m, y_m, heading_rad] = *values;
    if (!rows.empty() && t_s <= rows.back().t_s) {
      return Fail(ErrorCode::kInvalidArgument,
                  "{}, line {}: time {} s does not come after the line before ({} s)",
                  file.string(), number, t_s, rows.back().t_s);
    }
    rows.push_back({t_s, {x_m, y_m, heading_rad}});
  }
  if (rows.empty()) {
    return Fail(ErrorCode::kInvalidArgument, "{} holds no odometry, only a header", file.string());
  }
  return OdometryFile(file, std::move(rows));
}

Result<motion::Pose2> OdometryFile::At(SensorTime time) const {
  const double t_s = Seconds(time);
  if (t_s < rows_.front().t_s - kSlack_s || t_s > rows_.back().t_s + kSlack_s) {
    return Fail(ErrorCode::kInvalidArgument,
                "{} covers {:.2f} s to {:.2f} s, but a frame was taken at {:.2f} s: its times must "
                "count from the first frame, and --rate must be the frames' rate",
                file_.string(), rows_.front().t_s, rows_.back().t_s, t_s);
  }
  const auto after = std::lower_bound(rows_.begin(), rows_.end(), t_s,
                                      [](const Row& row, double t) { return row.t_s < t; });
  if (after == rows_.begin()) return rows_.front().pose;
  if (after == rows_.end()) return rows_.back().pose;
  const Row& before = *std::prev(after);
  const double share = (t_s - before.t_s) / (after->t_s - before.t_s);
  return motion::Interpolate(before.pose, after->pose, share);
}

}  // namespace trailcast::agent
