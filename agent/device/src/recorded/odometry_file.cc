#include "agent/device/odometry_file.h"

#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "agent/device/src/recorded/time_in.h"
#include "services/base/angles.h"
#include "services/base/number_table.h"

namespace trailcast::agent {
namespace {

// No wheeled robot turns this fast. Headings in degrees seem to, again and again; odometry that was
// restarted does once.
constexpr double kFastestTurn_radps = 8.0;
constexpr double kClearTurn_rad = 0.3;
constexpr std::size_t kRowsPerJump = 100;

bool TurnsTooFast(const NumberRow& before, const NumberRow& row) {
  const double turned_rad = std::abs(WrapAngle(row.cells[3] - before.cells[3]));
  return turned_rad > kFastestTurn_radps * (row.cells[0] - before.cells[0]) &&
         turned_rad > kClearTurn_rad;
}

Result<void> CheckTimes(const std::vector<NumberRow>& rows, const std::string& file) {
  for (std::size_t i = 1; i < rows.size(); ++i) {
    if (rows[i].cells[0] > rows[i - 1].cells[0]) continue;
    return Fail(ErrorCode::kInvalidArgument,
                "{}, line {}: time {} s does not come after the line before ({} s)", file,
                rows[i].line, rows[i].cells[0], rows[i - 1].cells[0]);
  }
  return {};
}

Result<void> CheckHeadings(const std::vector<NumberRow>& rows, const std::string& file) {
  std::vector<std::size_t> fast;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    if (TurnsTooFast(rows[i - 1], rows[i])) fast.push_back(i);
  }
  if (fast.size() * kRowsPerJump <= rows.size()) return {};
  const NumberRow& before = rows[fast.front() - 1];
  const NumberRow& row = rows[fast.front()];
  return Fail(ErrorCode::kInvalidArgument,
              "{}, line {}: the heading goes from {} to {} rad within {:.3f} s, faster than any "
              "robot turns: is it in degrees?",
              file, row.line, before.cells[3], row.cells[3], row.cells[0] - before.cells[0]);
}

}  // namespace

Result<OdometryFile> OdometryFile::Read(const std::filesystem::path& file) {
  const auto numbers = ReadNumbers(file, {"t_s", "x_m", "y_m", "heading_rad"});
  if (!numbers) return tl::unexpected(numbers.error());
  if (auto times = CheckTimes(*numbers, file.string()); !times)
    return tl::unexpected(times.error());
  if (auto paced = CheckPace(*numbers, file); !paced) return tl::unexpected(paced.error());
  if (auto right = CheckHeadings(*numbers, file.string()); !right) {
    return tl::unexpected(right.error());
  }
  std::vector<RecordedPoses::Sample> samples;
  samples.reserve(numbers->size());
  for (const NumberRow& row : *numbers) {
    const auto time = TimeIn(row, file);
    if (!time) return tl::unexpected(time.error());
    samples.push_back({*time, {row.cells[1], row.cells[2], row.cells[3]}});
  }
  if (samples.empty()) {
    return Fail(ErrorCode::kInvalidArgument, "{} holds no odometry, only a header", file.string());
  }
  if (auto slow = CheckSpeed(samples); !slow) return Wrap(slow.error(), file.string());
  return OdometryFile(file, RecordedPoses(samples));
}

Result<motion::Pose2> OdometryFile::At(SensorTime time) const {
  const SensorTime slack = FromSeconds(kSlack_s);
  if (time < poses_.history().oldest() - slack || time > poses_.history().newest() + slack) {
    return Fail(ErrorCode::kInvalidArgument,
                "{} covers {:.2f} s to {:.2f} s, but a frame was taken at {:.2f} s: its times must "
                "count from the first frame, and --rate must be the frames' rate, or --frame-times "
                "say when frames were taken by the same clock",
                file_.string(), Seconds(poses_.history().oldest()),
                Seconds(poses_.history().newest()), Seconds(time));
  }
  return poses_.history().At(time);
}

}  // namespace trailcast::agent
