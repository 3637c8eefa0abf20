#include "agent/device/obstacle_options.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>

#include "services/base/number.h"

namespace trailcast::agent {
namespace {

// A margin on either side, because scanners and paths are not exact.
constexpr double kMargin_m = 0.05;
constexpr double kDegree_rad = std::numbers::pi / 180.0;
constexpr double kMost_m = 5.0;
constexpr double kMost_deg = 180.0;

std::optional<double> Within(std::string_view text, double most) {
  const auto value = ParseNumber<double>(text);
  return value && std::abs(*value) <= most ? value : std::nullopt;
}

std::optional<motion::Pose2> ParseMount(std::string_view text) {
  const std::size_t first = text.find(',');
  const std::size_t second = text.find(',', first + 1);
  if (first == std::string_view::npos || second == std::string_view::npos) return std::nullopt;
  const auto ahead_m = Within(text.substr(0, first), kMost_m);
  const auto left_m = Within(text.substr(first + 1, second - first - 1), kMost_m);
  const auto turned_deg = Within(text.substr(second + 1), kMost_deg);
  if (!ahead_m || !left_m || !turned_deg) return std::nullopt;
  return motion::Pose2{*ahead_m, *left_m, *turned_deg * kDegree_rad};
}

}  // namespace

motion::Outline OutlineOf(const ObstacleOptions& options) {
  const double half_m = options.robot_width_m / 2.0;
  return {std::max(half_m, options.scan_ahead_m), half_m + kMargin_m};
}

Result<RangeSensor> ParseRangeSensor(const std::string& text) {
  const std::size_t at = text.find('@');
  if (at == std::string::npos) return RangeSensor{text, std::nullopt};
  const auto mount = ParseMount(std::string_view(text).substr(at + 1));
  if (mount) return RangeSensor{text.substr(0, at), mount};
  return Fail(ErrorCode::kInvalidArgument,
              "'{}' is no range sensor: expected TOPIC, or TOPIC@AHEAD,LEFT,DEGREES, metres from "
              "the axle and how far to the left it looks, as sonar@0.2,-0.1,-30",
              text);
}

}  // namespace trailcast::agent
