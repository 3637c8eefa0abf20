#pragma once

#include <chrono>
#include <optional>
#include <vector>

#include "services/base/time.h"

namespace trailcast::agent {

// The two times of a recorded message: its sensor's stamp (0 if there is none), and when it was
// recorded.
struct RecordedTimes {
  SensorTime stamp{};
  std::chrono::nanoseconds logged_at{};
};

// The messages of one topic, in the order in which they were recorded, by clocks that rise.
struct RecordedClock {
  struct Message {
    // A StampClock makes it later than all before. A message out of order has none.
    std::optional<SensorTime> taken{};
    // The recorder's time, made to rise as well.
    SensorTime came{};
  };
  std::vector<Message> messages{};
};

// Makes times that rise from a recording's two clocks. Either may have been set on the way, may
// stand, or be wrong for a while. The recorder's clock counts while it advances as messages do;
// otherwise the stamps do, if they advance; otherwise the usual pause between two messages is
// added.
[[nodiscard]] RecordedClock FollowClocks(const std::vector<RecordedTimes>& topic);

// Returns how much longer pictures are under way than odometry of the same time, by their stamps.
// Beyond a second or two, their clocks differ. It is nothing if none of the two are of one time.
[[nodiscard]] std::optional<std::chrono::nanoseconds> Apart(const RecordedClock& pictures,
                                                            const RecordedClock& odometry);

}  // namespace trailcast::agent
