#pragma once

#include <sys/types.h>

#include <cstdint>
#include <optional>
#include <span>

namespace trailcast::soak {

// What a process has of its machine, from /proc.
struct Vitals {
  std::uint64_t memory_kb = 0;  // resident
  int threads = 0;
  int descriptors = 0;
};

// Nothing when the process is gone.
[[nodiscard]] std::optional<Vitals> VitalsOf(pid_t pid);

// From the first to the last quarter of the samples: medians.
struct Growth {
  Vitals first;
  Vitals last;
  [[nodiscard]] double memory_share() const;  // 0.05: five percent more
};

// Nothing when there are fewer than eight samples: too few to tell growth from chance.
[[nodiscard]] std::optional<Growth> GrowthOf(std::span<const Vitals> samples);

// Memory within 5 %, and no more threads and descriptors than at first.
[[nodiscard]] bool IsFlat(const Growth& growth);

}  // namespace trailcast::soak
