#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "services/base/ids.h"
#include "services/exchange/messages.h"

namespace trailcast::agent {

// What a camera sees, for people.
struct CameraPicture {
  std::vector<std::uint8_t> jpeg{};  // empty: there is none
  bool marked = false;               // the features that the robot follows are drawn on it
  std::string detail{};              // why there is none, or what is drawn on it; one line
};

// Who wants to see through this robot's camera. Each request gets one picture, made for it, whoever
// asked first before others; at most five a second in all, so that people who look take no more
// than their part of a radio. No I/O, no clock of its own.
class GlanceDesk {
 public:
  using Time = std::chrono::steady_clock::time_point;
  static constexpr std::chrono::milliseconds kEvery{200};
  static constexpr std::size_t kMostClients = 8;  // that wait; more are not heard
  // Who has asked waits no longer than this, and is told before that why no picture comes.
  static constexpr std::chrono::milliseconds kAskedFor{1000};
  static constexpr std::chrono::milliseconds kPatience{700};

  explicit GlanceDesk(AgentId self) : self_(std::move(self)) {}

  void Handle(const exchange::Message& message, Time now);
  // A picture is to be made now. True once for each.
  [[nodiscard]] bool Asks(Time now);
  // The one that was asked for has not come within kPatience.
  [[nodiscard]] bool AskedInVain(Time now) const;
  // What was made, to be published; nothing when nobody waits for it.
  [[nodiscard]] std::optional<exchange::Glance> Give(CameraPicture picture, Time now);

 private:
  struct Waiting {
    exchange::GlanceRequest request;
    Time since{};
  };
  void Forget(Time now);

  AgentId self_;
  std::deque<Waiting> waiting_;  // the first for longest
  bool asked_ = false;           // for a picture, which has not come
  std::optional<Time> asked_at_;
};

}  // namespace trailcast::agent
