#include "agent/device/sensed_poses.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace trailcast::agent {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;

// A picture may take so long to arrive and still be of the same clock as odometry. Once two clocks
// are assumed, the second bound makes them one again.
constexpr milliseconds kSensorsSameClock{500};
constexpr milliseconds kSensorsSameClockAgain{400};
// Clocks are compared by the quickest samples of a period, and by the median of some periods.
constexpr milliseconds kPeriod{500};
constexpr milliseconds kLongestPeriod{1000};
constexpr std::size_t kPeriods = 7;

bool Same(const motion::Pose2& a, const motion::Pose2& b) {
  return a.x_m == b.x_m && a.y_m == b.y_m && a.heading_rad == b.heading_rad;
}

void Tell(const char* whose, const std::string& news, std::vector<std::string>& to) {
  if (!news.empty()) to.push_back(fmt::format("{}: {}", whose, news));
}

}  // namespace

bool SensedPoses::AddOdometry(SensorTime stamp, const motion::Pose2& pose, Time came_at,
                              const motion::VelocityCommand& told) {
  const bool repeated = newest_raw_ && stamp == newest_stamp_ && Same(pose, *newest_raw_);
  if (repeated && !odometry_clock_.stands()) return false;
  const auto taken = odometry_clock_.Follow(stamp, came_at);
  if (!taken) return false;
  newest_stamp_ = stamp;
  newest_raw_ = pose;
  const OdometryGate::Passed passed = gate_.Pass(*taken, pose, told);
  if (passed.jump) {
    unknown_.distance_m += passed.jump->unknown.distance_m;
    unknown_.heading_change_rad += passed.jump->unknown.heading_change_rad;
    news_.push_back(passed.jump->Text());
  }
  poses_.Add(*taken, passed.pose);
  CompareClocks(came_at);
  return true;
}

std::optional<SensorTime> SensedPoses::AddFrame(SensorTime stamp, Time came_at) {
  const auto taken = frame_clock_.Follow(stamp, came_at);
  CompareClocks(came_at);
  return taken;
}

// Each period is compared by itself, so that a simulator's slow clock does not look like two
// clocks.
void SensedPoses::CompareClocks(Time now) {
  const nanoseconds period = now - period_from_;
  if (clocks_ == Clocks::kOne || period < kPeriod) return;
  period_from_ = now;
  const auto frames = frame_clock_.TakeBehind();
  const auto odometry = odometry_clock_.TakeBehind();
  // In a longer period nothing came, and a simulator's clock may have stood meanwhile.
  if (!frames || !odometry || period > kLongestPeriod) return;
  apart_.push_back(*frames - *odometry);
  if (apart_.size() > kPeriods) apart_.pop_front();
  std::vector<nanoseconds> sorted(apart_.begin(), apart_.end());
  std::sort(sorted.begin(), sorted.end());
  const nanoseconds apart = sorted[sorted.size() / 2];
  const bool were_apart = clocks_apart_ != nanoseconds(0);
  const bool are_apart =
      std::chrono::abs(apart) > (were_apart ? kSensorsSameClockAgain : kSensorsSameClock);
  clocks_apart_ = are_apart ? apart : nanoseconds(0);
  if (are_apart && !were_apart) {
    news_.push_back(
        fmt::format("the stamps of pictures and odometry are of different clocks, {:.2f} s apart: "
                    "goes by when they come",
                    Seconds(std::chrono::abs(apart))));
  }
}

motion::OdometryIncrement SensedPoses::TakeUnknown() { return std::exchange(unknown_, {}); }

std::vector<std::string> SensedPoses::TakeNews() {
  Tell("pictures", frame_clock_.TakeNews(), news_);
  Tell("odometry", odometry_clock_.TakeNews(), news_);
  return std::exchange(news_, {});
}

}  // namespace trailcast::agent
