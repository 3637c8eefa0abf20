#pragma once

#include <chrono>
#include <optional>
#include <vector>

#include "services/base/time.h"

namespace trailcast::agent {

// A recorded message has two times: its sensor stamped one (0: it did not), and it was recorded at
// the other.
struct RecordedTimes {
  SensorTime stamp{};
  std::chrono::nanoseconds logged_at{};
};

// The messages of one topic, in the order in which they were recorded, by clocks that go forward.
struct RecordedClock {
  struct Message {
    // A StampClock makes it later than those before. A message that came out of turn has none.
    std::optional<SensorTime> taken{};
    // The recorder's time is made to go forward likewise.
    SensorTime came{};
  };
  std::vector<Message> messages{};
};

// Either of a recording's two clocks may have been set on the way, may stand, or have a wrong time
// for a while: the recorder's is gone by while it goes on as messages do, the stamps where they go
// on and it does not, and the usual pause between two messages where neither does.
[[nodiscard]] RecordedClock FollowClocks(const std::vector<RecordedTimes>& topic);

// How much longer pictures are under way by their stamps than odometry of the same time is: beyond
// a second or two, their clocks are not the same one. Nothing: nothing of the two is of one time.
[[nodiscard]] std::optional<std::chrono::nanoseconds> Apart(const RecordedClock& pictures,
                                                            const RecordedClock& odometry);

}  // namespace trailcast::agent
