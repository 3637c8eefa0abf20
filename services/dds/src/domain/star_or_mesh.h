#pragma once

#include <chrono>
#include <optional>

#include "services/dds/dds_exchange.h"
#include "services/exchange/servers_there.h"

namespace trailcast::dds {

// Decides for one process whether it is in a star or in a mesh, and when it calls for a server. It
// has no I/O and no clock.
class StarOrMesh {
 public:
  using Time = std::chrono::steady_clock::time_point;
  using Clock = std::chrono::steady_clock;

  // Without a server for so long after joining, the process changes to a mesh. It waits longer if
  // anybody has answered: that is a server that is busy with a large fleet, or a member of a mesh,
  // which hears everybody anyway.
  static constexpr std::chrono::seconds kLooks{3};
  static constexpr std::chrono::seconds kLooksLonger{10};
  // Once there is a server, the process returns to the star between these times, so that not all
  // return at once.
  static constexpr std::chrono::milliseconds kReturnsFrom{1'000};
  static constexpr std::chrono::milliseconds kReturnsUntil{5'000};
  // Without a server it calls again after so long, doubled each time.
  static constexpr std::chrono::seconds kCallsFrom{1};
  static constexpr std::chrono::seconds kCallsUntil{8};

  // `share` is drawn at random, 0 to 1.
  StarOrMesh(Discovery wanted, double share) : wanted_(wanted), share_(share) {
    star_ = wanted != Discovery::kMesh;
  }

  // Says whether to join a star.
  [[nodiscard]] bool star() const { return star_; }
  // Notes that it has joined, or joined again.
  void Begin(Time now);
  // Servers are known by their statuses.
  void Hear(const exchange::Message& message) { servers_.Handle(message); }

  struct Seen {
    bool server = false;   // a writer that only servers have is connected
    bool anybody = false;  // another participant is connected
  };
  enum class Step : std::uint8_t { kNone, kCall, kJoinAnew };
  // Decides the next step; the caller asks every second or so. kJoinAnew means that star() has
  // changed.
  [[nodiscard]] Step Look(const Seen& seen, Time now);

 private:
  Discovery wanted_;
  double share_;
  bool star_;
  bool met_ = false;  // it has met a server in this star
  Time began_{};
  exchange::ServersThere servers_;
  std::optional<Time> return_at_;
  Time call_at_{};
  Clock::duration call_after_{};
};

}  // namespace trailcast::dds
