#pragma once

#include <chrono>
#include <stdexcept>
#include <string>
#include <vector>

#include "bus.h"
#include "trailcast.h"

namespace peer {

using Clock = std::chrono::steady_clock;

// By when a command has what it wants, or fails.
inline constexpr std::chrono::seconds kPatience{30};
// What is lost is asked for, or said, again so often.
inline constexpr std::chrono::milliseconds kAgain{500};

inline constexpr const char* kName = "fast-dds";

// Says `say` at once and every so often, hears by `heard` what came, until that is enough.
template <typename Say, typename Heard>
void Until(Bus& bus, const std::string& wanted, const Say& say, const Heard& heard) {
  const auto deadline = Clock::now() + kPatience;
  auto again = Clock::now();
  while (!heard()) {
    if (Clock::now() > deadline) throw std::runtime_error("in vain: " + wanted);
    if (Clock::now() >= again) {
      say();
      again = Clock::now() + kAgain;
    }
    bus.Wait(std::chrono::milliseconds(100));
  }
}

// The server's routes, all of them or those of a name.
[[nodiscard]] std::vector<trailcast::wire::CatalogRoute> List(Bus& bus, const std::string& name);

// A complete route with all its segments, in order, each found to be what its digest says, and all
// together what the manifest says.
struct Fetched {
  trailcast::wire::CatalogRoute route;
  std::vector<trailcast::wire::SegmentPiece> pieces;
};
[[nodiscard]] Fetched Fetch(Bus& bus, const std::string& name);

// A server took the same segments for a new route of ours, and confirmed that they are on its disk.
// What was published.
[[nodiscard]] trailcast::wire::CatalogRoute Publish(Bus& bus, const Fetched& fetched,
                                                    const std::string& name);

}  // namespace peer
