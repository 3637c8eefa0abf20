#include "agent/device/recorded_poses.h"

#include <algorithm>
#include <cmath>

namespace trailcast::agent {
namespace {

constexpr double kUsual = 0.9;       // this share of all samples is slower, or has a shorter pause
constexpr double kTimesUsual = 3.0;  // the most that a base can do
// A car on a motorway is slower. A robot at a slow walk is faster if its metres are millimetres.
constexpr double kFastest_mps = 60.0;

double QuantileOf(std::vector<double>& values) {
  const auto at =
      values.begin() + static_cast<std::ptrdiff_t>(kUsual * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

// The drive's own samples set the bounds, because the base may be a car's and its odometry may come
// once a second.
GateOptions GateOf(const std::vector<RecordedPoses::Sample>& samples) {
  std::vector<double> gaps_s;
  std::vector<double> speeds_mps;
  std::vector<double> rates_radps;
  for (std::size_t i = 1; i < samples.size(); ++i) {
    const double gap_s = Seconds(samples[i].taken - samples[i - 1].taken);
    if (gap_s <= 0.0) continue;
    const motion::Pose2 moved = motion::Between(samples[i - 1].pose, samples[i].pose);
    gaps_s.push_back(gap_s);
    speeds_mps.push_back(motion::Position(moved).norm() / gap_s);
    rates_radps.push_back(std::abs(moved.heading_rad) / gap_s);
  }
  GateOptions options;
  if (gaps_s.empty()) return options;
  options.speed_mps = std::max(options.speed_mps, kTimesUsual * QuantileOf(speeds_mps));
  options.turn_rate_radps =
      std::max(options.turn_rate_radps, kTimesUsual * QuantileOf(rates_radps));
  options.longest_silence_s = std::max(options.longest_silence_s, kTimesUsual * QuantileOf(gaps_s));
  return options;
}

}  // namespace

Result<void> CheckSpeed(const std::vector<RecordedPoses::Sample>& samples) {
  const double fastest_mps = GateOf(samples).speed_mps / kTimesUsual;
  if (fastest_mps <= kFastest_mps) return {};
  return Fail(ErrorCode::kInvalidArgument,
              "by this odometry the robot drives at {:.0f} m/s, which no robot does: is it in "
              "millimetres or centimetres? Expected metres",
              fastest_mps);
}

RecordedPoses::RecordedPoses(const std::vector<Sample>& samples) {
  OdometryGate gate(GateOf(samples));
  for (const Sample& sample : samples) {
    if (!history_.empty() && sample.taken <= history_.newest()) continue;
    const OdometryGate::Passed passed = gate.Pass(sample.taken, sample.pose);
    history_.Add(sample.taken, passed.pose);
    if (passed.jump) jumps_.push_back({sample.taken, *passed.jump});
  }
}

motion::OdometryIncrement RecordedPoses::TakeUnknown(SensorTime until,
                                                     std::vector<std::string>& news) {
  motion::OdometryIncrement unknown;
  for (; taken_ < jumps_.size() && jumps_[taken_].taken <= until; ++taken_) {
    const OdometryJump& jump = jumps_[taken_].jump;
    unknown.distance_m += jump.unknown.distance_m;
    unknown.heading_change_rad += jump.unknown.heading_change_rad;
    news.push_back(jump.Text());
  }
  return unknown;
}

}  // namespace trailcast::agent
