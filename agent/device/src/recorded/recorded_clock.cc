#include "agent/device/recorded_clock.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "agent/device/stamp_clock.h"

namespace trailcast::agent {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;

// The recorder writes in the order of arrival, except for the disorder of its threads.
constexpr milliseconds kRecordersOutOfTurn{200};
// If a clock advances by more between two messages, it was set, or there was a pause.
constexpr milliseconds kLongestUsual{1000};
constexpr int kTimesUsualPause = 3;
constexpr milliseconds kUsualOfNone{100};

// Returns the median pause between messages, or nothing if time never advances.
template <typename TimeOf>
std::optional<nanoseconds> UsualPause(const std::vector<RecordedTimes>& topic,
                                      const TimeOf& time_of) {
  std::vector<nanoseconds> pauses;
  for (std::size_t i = 1; i < topic.size(); ++i) {
    const nanoseconds pause = time_of(topic[i]) - time_of(topic[i - 1]);
    if (pause > nanoseconds(0)) pauses.push_back(pause);
  }
  if (pauses.empty()) return std::nullopt;
  const auto middle = pauses.begin() + static_cast<std::ptrdiff_t>(pauses.size() / 2);
  std::nth_element(pauses.begin(), middle, pauses.end());
  return *middle;
}

// Tells when messages came, by the recorder's clock as long as that advances.
class Arrivals {
 public:
  explicit Arrivals(const std::vector<RecordedTimes>& topic)
      : topic_(topic),
        usual_(UsualPause(topic, [](const RecordedTimes& each) { return each.logged_at; })
                   .value_or(UsualPause(topic, [](const RecordedTimes& each) { return each.stamp; })
                                 .value_or(kUsualOfNone))),
        longest_(std::max<nanoseconds>(kLongestUsual, kTimesUsualPause * usual_)),
        logged_at_(topic.front().logged_at),
        came_(logged_at_),
        last_(logged_at_) {}

  // Must be called for one message after the other.
  [[nodiscard]] SensorTime Came(std::size_t i) {
    last_ = std::max(last_ + nanoseconds(1), After(i));
    return last_;
  }

 private:
  [[nodiscard]] bool IsUsual(nanoseconds pause) const {
    return pause > nanoseconds(0) && pause <= longest_;
  }
  [[nodiscard]] SensorTime After(std::size_t i) {
    const nanoseconds logged = topic_[i].logged_at - logged_at_;
    if (logged < nanoseconds(0) && logged > -kRecordersOutOfTurn) return last_;
    if (!IsUsual(logged) && i + 1 < topic_.size()) {
      // Only its own time is wrong if the next message continues from the one before.
      const nanoseconds next = topic_[i + 1].logged_at - logged_at_;
      if (IsUsual(next)) return came_ + next / 2;
    }
    came_ += Pause(logged, topic_[i].stamp - topic_[i - 1].stamp);
    logged_at_ = topic_[i].logged_at;
    return came_;
  }
  [[nodiscard]] nanoseconds Pause(nanoseconds logged, nanoseconds stamped) const {
    constexpr nanoseconds kNone{0};
    if (IsUsual(logged)) return logged;
    if (IsUsual(stamped)) return stamped;
    if (logged > kNone) return stamped > kNone ? std::min(logged, stamped) : logged;
    return logged == kNone && stamped > kNone ? stamped : usual_;
  }

  const std::vector<RecordedTimes>& topic_;
  nanoseconds usual_;
  nanoseconds longest_;
  // These are the times of the last message whose recorded time was right.
  nanoseconds logged_at_;
  SensorTime came_;
  SensorTime last_;  // the latest of all
};

}  // namespace

RecordedClock FollowClocks(const std::vector<RecordedTimes>& topic) {
  RecordedClock clock;
  if (topic.empty()) return clock;
  clock.messages.reserve(topic.size());
  Arrivals arrivals(topic);
  StampClock stamps;
  for (std::size_t i = 0; i < topic.size(); ++i) {
    const SensorTime came = i == 0 ? topic[i].logged_at : arrivals.Came(i);
    clock.messages.push_back({stamps.Follow(topic[i].stamp, StampClock::Time(came)), came});
  }
  return clock;
}

std::optional<nanoseconds> Apart(const RecordedClock& pictures, const RecordedClock& odometry) {
  std::vector<nanoseconds> apart;
  auto near = odometry.messages.begin();
  for (const RecordedClock::Message& picture : pictures.messages) {
    while (near != odometry.messages.end() && near->came < picture.came) ++near;
    if (near == odometry.messages.end()) break;
    if (!picture.taken || !near->taken || near->came - picture.came > kLongestUsual) continue;
    apart.push_back((picture.came - *picture.taken) - (near->came - *near->taken));
  }
  if (apart.empty()) return std::nullopt;
  const auto middle = apart.begin() + static_cast<std::ptrdiff_t>(apart.size() / 2);
  std::nth_element(apart.begin(), middle, apart.end());
  return *middle;
}

}  // namespace trailcast::agent
