#pragma once

#include <sys/resource.h>
#include <unistd.h>

namespace trailcast {

// Sets the niceness of the calling thread alone. At 19 it gets only what all other threads leave
// over.
inline void GiveWay(int niceness) {
  (void)setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), niceness);
}

}  // namespace trailcast
