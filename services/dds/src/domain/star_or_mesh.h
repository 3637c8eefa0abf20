#pragma once

#include <chrono>
#include <optional>

#include "services/dds/dds_exchange.h"
#include "services/exchange/servers_there.h"

namespace trailcast::dds {

// Decides for one process, as time goes by, whether it is in a star or in a mesh, and when it
// calls for a server. No I/O, no clock.
class StarOrMesh {
 public:
  using Time = std::chrono::steady_clock::time_point;
  using Clock = std::chrono::steady_clock;

  // Without a server so long after joining, a mesh. Longer where anybody at all has answered: that
  // is a server which is busy with a large fleet, or who is in a mesh and hears all others anyway.
  static constexpr std::chrono::seconds kLooks{3};
  static constexpr std::chrono::seconds kLooksLonger{10};
  // Once there is a server, back to the star between these, so that not all go at once.
  static constexpr std::chrono::milliseconds kReturnsFrom{1'000};
  static constexpr std::chrono::milliseconds kReturnsUntil{5'000};
  // Calls again after so long without a server, doubled each time.
  static constexpr std::chrono::seconds kCallsFrom{1};
  static constexpr std::chrono::seconds kCallsUntil{8};

  // `share`: 0 to 1, drawn at random.
  StarOrMesh(Discovery wanted, double share) : wanted_(wanted), share_(share) {
    star_ = wanted != Discovery::kMesh;
  }

  // How to join.
  [[nodiscard]] bool star() const { return star_; }
  // It has joined, or joined anew.
  void Begin(Time now);
  // Servers are told by their statuses.
  void Hear(const exchange::Message& message) { servers_.Handle(message); }

  struct Seen {
    bool server = false;   // something that servers alone write is connected
    bool anybody = false;  // else
  };
  enum class Step : std::uint8_t { kNone, kCall, kJoinAnew };
  // To be asked every second or so. kJoinAnew: star() has changed.
  [[nodiscard]] Step Look(const Seen& seen, Time now);

 private:
  Discovery wanted_;
  double share_;
  bool star_;
  bool met_ = false;  // a server, in this star
  Time began_{};
  exchange::ServersThere servers_;
  std::optional<Time> return_at_;
  Time call_at_{};
  Clock::duration call_after_{};
};

}  // namespace trailcast::dds
