#pragma once

#include <sys/resource.h>
#include <unistd.h>

namespace trailcast {

// The calling thread alone is of this niceness from now on: 19 is what is left over by all others.
inline void GiveWay(int niceness) {
  (void)setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), niceness);
}

}  // namespace trailcast
