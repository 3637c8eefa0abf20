#pragma once

#include <chrono>
#include <stdexcept>
#include <string>
#include <vector>

#include "bus.h"
#include "trailcast.h"

namespace peer {

using Clock = std::chrono::steady_clock;

// A command has its answer within this time, or fails.
inline constexpr std::chrono::seconds kPatience{30};
// A lost message is repeated so often.
inline constexpr std::chrono::milliseconds kAgain{500};

inline constexpr const char* kName = "fast-dds";

// Calls `say` at once and repeatedly, and passes what came to `heard`, until that returns true.
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

// Asks for the server's routes, all of them or those of a name.
[[nodiscard]] std::vector<trailcast::wire::CatalogRoute> List(Bus& bus, const std::string& name);

// This is a complete route with all its segments, in order. Each has the bytes of its digest, and
// all together match the manifest.
struct Fetched {
  trailcast::wire::CatalogRoute route;
  std::vector<trailcast::wire::SegmentPiece> pieces;
};
[[nodiscard]] Fetched Fetch(Bus& bus, const std::string& name);

// Publishes the same segments as a new route of its own, and waits until a server has acknowledged
// that they are on its disk. Returns what was published.
[[nodiscard]] trailcast::wire::CatalogRoute Publish(Bus& bus, const Fetched& fetched,
                                                    const std::string& name);

}  // namespace peer
