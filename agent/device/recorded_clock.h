#pragma once

#include <chrono>
#include <optional>
#include <vector>

#include "services/base/time.h"

namespace trailcast::agent {

// Of a recorded message: what its sensor stamped (0: nothing), and when it was recorded.
struct RecordedTimes {
  SensorTime stamp{};
  std::chrono::nanoseconds logged_at{};
};

// The messages of one topic, in the order in which they were recorded, by clocks that go forward.
struct RecordedClock {
  struct Message {
    // As a StampClock has it: later than those before; nothing for one that came out of turn.
    std::optional<SensorTime> taken{};
    // When it came, likewise.
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
