#pragma once

#include <exception>
#include <string_view>
#include <type_traits>
#include <utility>

#include "services/base/result.h"

namespace trailcast {

// A thread's body, run so that nothing it throws ends the program: a robot whose program ends that
// way has been told by nobody to stand. `body` returns a Result<void>, or nothing; what it throws
// becomes an error that names the thread, for its owner to end the run with.
template <typename Body>
[[nodiscard]] Result<void> Guarded(std::string_view thread, Body&& body) {
  const auto failed = [&](std::string_view what) {
    return Fail(ErrorCode::kInternal,
                "{} has failed ({}): this is a fault of the program; please report it with its log",
                thread, what);
  };
  try {
    if constexpr (std::is_void_v<std::invoke_result_t<Body>>) {
      std::forward<Body>(body)();
      return {};
    } else {
      return std::forward<Body>(body)();
    }
  } catch (const std::exception& thrown) {
    return failed(thrown.what());
  } catch (...) {
    return failed("something was thrown that is no exception");
  }
}

}  // namespace trailcast
