#include "agent/device/odometry_file.h"

#include <cmath>
#include <utility>

#include "agent/device/src/time_in.h"
#include "services/base/angles.h"
#include "services/base/number_table.h"

namespace trailcast::agent {
namespace {

// No robot on wheels turns as fast; headings in degrees do.
constexpr double kFastestTurn_radps = 8.0;
constexpr double kClearTurn_rad = 0.3;

Result<void> Follows(const NumberRow& before, const NumberRow& row, const std::string& file) {
  const double dt_s = row.cells[0] - before.cells[0];
  if (dt_s <= 0.0) {
    return Fail(ErrorCode::kInvalidArgument,
                "{}, line {}: time {} s does not come after the line before ({} s)", file, row.line,
                row.cells[0], before.cells[0]);
  }
  const double turned_rad = std::abs(WrapAngle(row.cells[3] - before.cells[3]));
  if (turned_rad > kFastestTurn_radps * dt_s && turned_rad > kClearTurn_rad) {
    return Fail(ErrorCode::kInvalidArgument,
                "{}, line {}: the heading goes from {} to {} rad within {:.3f} s, faster than any "
                "robot turns: is it in degrees?",
                file, row.line, before.cells[3], row.cells[3], dt_s);
  }
  return {};
}

}  // namespace

Result<OdometryFile> OdometryFile::Read(const std::filesystem::path& file) {
  const auto numbers = ReadNumbers(file, {"t_s", "x_m", "y_m", "heading_rad"});
  if (!numbers) return tl::unexpected(numbers.error());
  PoseHistory poses(std::chrono::nanoseconds::max());
  for (std::size_t i = 0; i < numbers->size(); ++i) {
    const NumberRow& row = (*numbers)[i];
    if (i > 0) {
      if (auto follows = Follows((*numbers)[i - 1], row, file.string()); !follows) {
        return tl::unexpected(follows.error());
      }
    }
    const auto time = TimeIn(row, file);
    if (!time) return tl::unexpected(time.error());
    poses.Add(*time, {row.cells[1], row.cells[2], row.cells[3]});
  }
  if (poses.empty()) {
    return Fail(ErrorCode::kInvalidArgument, "{} holds no odometry, only a header", file.string());
  }
  return OdometryFile(file, std::move(poses));
}

Result<motion::Pose2> OdometryFile::At(SensorTime time) const {
  const SensorTime slack = FromSeconds(kSlack_s);
  if (time < poses_.oldest() - slack || time > poses_.newest() + slack) {
    return Fail(ErrorCode::kInvalidArgument,
                "{} covers {:.2f} s to {:.2f} s, but a frame was taken at {:.2f} s: its times must "
                "count from the first frame, and --rate must be the frames' rate, or --frame-times "
                "say when frames were taken by the same clock",
                file_.string(), Seconds(poses_.oldest()), Seconds(poses_.newest()), Seconds(time));
  }
  return poses_.At(time);
}

}  // namespace trailcast::agent
