#include "services/mission/driver_seat.h"

#include <algorithm>
#include <cmath>

namespace trailcast::mission {
namespace {

using std::chrono::duration_cast;
using std::chrono::milliseconds;

// Clocks drift apart by less than this.
constexpr double kDrift_ms_per_s = 1.0;
// No command is under way for this long, so the driver has another clock than before.
constexpr double kOtherClock_ms = 10'000.0;

}  // namespace

void DriverSeat::Sit(const std::string& driver, double delay_ms) {
  driver_ = driver;
  least_delay_ms_ = delay_ms;
  last_said_ms_ = 0;
}

DriverSeat::Verdict DriverSeat::Hear(const std::string& driver, std::uint64_t said_ms, Time now) {
  if (driver != driver_ && IsTaken(now)) return Verdict::kTaken;
  const auto now_ms = duration_cast<milliseconds>(now.time_since_epoch()).count();
  const auto delay_ms =
      static_cast<double>(static_cast<std::int64_t>(static_cast<std::uint64_t>(now_ms) - said_ms));
  const bool other_clock = std::abs(delay_ms - least_delay_ms_) > kOtherClock_ms;
  if (driver != driver_ || other_clock) Sit(driver, delay_ms);
  const double since_s = std::chrono::duration<double>(now - last_heard_).count();
  least_delay_ms_ = std::min(least_delay_ms_ + kDrift_ms_per_s * std::max(0.0, since_s), delay_ms);
  last_heard_ = now;
  late_ = milliseconds(static_cast<std::int64_t>(delay_ms - least_delay_ms_));
  if (late_ >= kGoodFor || said_ms < last_said_ms_) return Verdict::kLate;
  last_said_ms_ = said_ms;
  good_until_ = now + kGoodFor - late_;
  free_at_ = now + kFreeAfter;
  return Verdict::kGood;
}

}  // namespace trailcast::mission
