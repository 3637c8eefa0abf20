#pragma once

#include <chrono>
#include <functional>
#include <map>

#include "services/dds/src/domain/joined.h"

namespace trailcast::dds {

// Knows which writers have lately written samples that their readers may lack, and when to remind
// those. A reader notices a lost sample by the next one, and the loss of the last one by Cyclone's
// heartbeats. These are rare in a star, so reminders replace them where somebody waits. It has no
// clock and no socket.
class Reminders {
 public:
  using Time = std::chrono::steady_clock::time_point;
  static constexpr std::chrono::milliseconds kFirst{20};  // doubled after each, because all readers
                                                          // answer
  static constexpr std::chrono::milliseconds kMost{500};  // a reader that does not answer by then
                                                          // may be dead

  void NoteWritten(const Place& place, Time now) { written_[place] = {now + kFirst, kFirst}; }
  // Goes through the writers that are due: it forgets those that are confirmed and has the others
  // remind their readers.
  void Tick(Time now, const std::function<bool(const Place&)>& is_confirmed,
            const std::function<void(const Place&)>& remind);
  // Returns the time until the next one is due, at most `max_wait`.
  [[nodiscard]] std::chrono::milliseconds Wait(Time now, std::chrono::milliseconds max_wait) const;
  void Clear() { written_.clear(); }

 private:
  struct Written {
    Time due_at;
    std::chrono::milliseconds waited;
  };
  std::map<Place, Written> written_;
};

}  // namespace trailcast::dds
