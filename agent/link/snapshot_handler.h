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

// A camera's picture, for people.
struct CameraPicture {
  std::vector<std::uint8_t> jpeg{};  // empty if there is none
  bool marked = false;               // the features that the robot follows are drawn on it
  std::string detail{};              // why there is none, or what is drawn on it, in one line
};

// Manages requests for snapshots from this robot's camera. Each request gets one picture, made for
// it, and the oldest request comes first. There are at most five pictures a second in all, so that
// viewers take only their share of the radio. It has no I/O and no clock of its own.
class SnapshotHandler {
 public:
  using Time = std::chrono::steady_clock::time_point;
  static constexpr std::chrono::milliseconds kEvery{200};
  static constexpr std::size_t kMostClients = 8;  // that wait; others are ignored
  // A request waits no longer than this, and is told before that why no picture comes.
  static constexpr std::chrono::milliseconds kAskedFor{1000};
  static constexpr std::chrono::milliseconds kPatience{700};

  explicit SnapshotHandler(AgentId self) : self_(std::move(self)) {}

  void Handle(const exchange::Message& message, Time now);
  // Returns true once for each picture that is to be made now.
  [[nodiscard]] bool Asks(Time now);
  // Says whether the requested picture did not come within kPatience.
  [[nodiscard]] bool AskedInVain(Time now) const;
  // Returns the picture as a message to publish, or nothing if nobody waits for it.
  [[nodiscard]] std::optional<exchange::Snapshot> Give(CameraPicture picture, Time now);

 private:
  struct Waiting {
    exchange::SnapshotRequest request;
    Time since{};
  };
  void Forget(Time now);

  AgentId self_;
  std::deque<Waiting> waiting_;  // the oldest first
  bool asked_ = false;           // a picture was requested and has not come
  std::optional<Time> asked_at_;
};

}  // namespace trailcast::agent
