#include "services/fleet/draw.h"

#include <fmt/format.h>

#include <random>

namespace trailcast::fleet {

std::uint64_t DrawNumber() {
  std::random_device random;
  return std::uniform_int_distribution<std::uint64_t>(1)(random);
}

std::string DrawMissionId() { return fmt::format("{:016x}", DrawNumber()); }

}  // namespace trailcast::fleet
