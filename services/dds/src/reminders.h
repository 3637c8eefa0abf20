#pragma once

#include <chrono>
#include <functional>
#include <map>

#include "services/dds/src/domain/joined.h"

namespace trailcast::dds {

// Which writers have lately written what their readers may lack, and when those are to be reminded.
// Readers notice what was lost by what comes after it, and of the last of it by Cyclone's
// heartbeats, which are rare in a star: there these are the ones that somebody waits for. No clock,
// no socket.
class Reminders {
 public:
  using Time = std::chrono::steady_clock::time_point;
  static constexpr std::chrono::milliseconds kFirst{20};  // after each twice as long: all answer
  static constexpr std::chrono::milliseconds kMost{500};  // a reader that says nothing may be dead

  void NoteWritten(const Place& place, Time now) { written_[place] = {now + kFirst, kFirst}; }
  // Of those that are due: forgets the confirmed ones, has the others reminded.
  void Tick(Time now, const std::function<bool(const Place&)>& is_confirmed,
            const std::function<void(const Place&)>& remind);
  // Until the next one is due, at most `max_wait`.
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
