#include "agent/device/stamp_clock.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace trailcast::agent {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;

// A sample this much older than the one before was overtaken by it. Beyond that, the clock was set.
constexpr milliseconds kOutOfTurn{200};
// If the arrival does not show a pause ahead of this length, the clock was set.
constexpr milliseconds kAhead{1000};
constexpr milliseconds kLeastLater{1};

}  // namespace

std::optional<SensorTime> StampClock::Follow(SensorTime stamp, Time came_at) {
  if (!last_) {
    last_ = Sample{stamp, stamp, came_at};
    NoteBehind();
    return stamp;
  }
  const nanoseconds later = std::max<nanoseconds>(came_at - last_->came_at, kLeastLater);
  const nanoseconds advance = stamp - last_->stamp;
  if (advance < nanoseconds(0) && advance > -kOutOfTurn) return std::nullopt;
  const bool stood = std::exchange(stands_, advance == nanoseconds(0));
  const bool stepped = advance < nanoseconds(0) || advance > later + kAhead;
  if (stands_ && !stood) news_ = "its stamps stand still: the time of arrival counts";
  if (stepped && !stood) {
    news_ = fmt::format("its clock went {} by {:.2f} s: goes on by the time of arrival",
                        advance < nanoseconds(0) ? "back" : "ahead",
                        Seconds(std::chrono::abs(advance - later)));
  }
  if (stands_ || stood || stepped) shift_ = last_->taken + later - stamp;
  last_ = Sample{stamp, stamp + shift_, came_at};
  NoteBehind();
  return last_->taken;
}

void StampClock::NoteBehind() {
  const nanoseconds behind = last_->came_at.time_since_epoch() - last_->taken;
  behind_ = std::min(behind_.value_or(behind), behind);
}

std::optional<nanoseconds> StampClock::TakeBehind() { return std::exchange(behind_, std::nullopt); }

std::string StampClock::TakeNews() { return std::exchange(news_, {}); }

}  // namespace trailcast::agent
