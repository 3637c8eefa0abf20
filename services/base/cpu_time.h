#pragma once

#include <ctime>

namespace trailcast {

// Returns the processor time that the calling thread has used.
[[nodiscard]] inline double ThreadCpuMs() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
}

}  // namespace trailcast
