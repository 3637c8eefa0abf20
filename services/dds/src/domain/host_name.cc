#include "services/dds/src/domain/host_name.h"

#include <sys/utsname.h>

#include <atomic>
#include <cstdio>

namespace trailcast::dds {
namespace {

std::atomic<bool> g_hidden{false};

}  // namespace

void HideHostName() { g_hidden = true; }

}  // namespace trailcast::dds

// This hides the C library's function from Cyclone's library as well, because the program is
// searched first.
extern "C" int gethostname(char* name, std::size_t size) noexcept {
  utsname machine{};
  const bool told = !trailcast::dds::g_hidden && uname(&machine) == 0;
  const int length = std::snprintf(name, size, "%s", told ? machine.nodename : "hidden");
  return length >= 0 && static_cast<std::size_t>(length) < size ? 0 : -1;
}
