#pragma once

#include <sys/types.h>

#include <cstdint>
#include <optional>
#include <span>

namespace trailcast::soak {

// This is what a process has of its machine, from /proc.
struct Vitals {
  std::uint64_t memory_kb = 0;  // resident
  int threads = 0;
  int descriptors = 0;
};

// Returns nothing when the process is gone.
[[nodiscard]] std::optional<Vitals> VitalsOf(pid_t pid);

// This is from the first to the last quarter of the samples, by their medians.
struct Growth {
  Vitals first;
  Vitals last;
  [[nodiscard]] double memory_share() const;  // 0.05 is five percent more
};

// Returns nothing for fewer than eight samples, which are too few to tell growth from chance.
[[nodiscard]] std::optional<Growth> GrowthOf(std::span<const Vitals> samples);

// Returns whether memory is within 5 %, with no more threads and descriptors than at first.
[[nodiscard]] bool IsFlat(const Growth& growth);

}  // namespace trailcast::soak
