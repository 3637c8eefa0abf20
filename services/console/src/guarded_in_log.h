#pragma once

#include <spdlog/spdlog.h>

#include <string_view>
#include <utility>

#include "services/base/guarded.h"

namespace trailcast::console {

// Does what Guarded does, and also writes a fault of the program to the console's log.
template <typename Body>
[[nodiscard]] auto GuardedInLog(std::string_view thread, Body&& body) {
  auto done = Guarded(thread, std::forward<Body>(body));
  if (!done && done.error().code == ErrorCode::kInternal) {
    spdlog::error("console: {}", done.error().message);
  }
  return done;
}

}  // namespace trailcast::console
