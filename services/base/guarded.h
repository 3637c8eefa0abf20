#pragma once

#include <exception>
#include <string_view>
#include <type_traits>
#include <utility>

#include "services/base/result.h"

namespace trailcast {

// Runs a thread's body so that no exception ends the program: a program that dies cannot tell its
// robot to stop. `body` returns a Result, or nothing. An exception becomes an error that names the
// thread, with which the thread's owner ends the run.
template <typename Body>
[[nodiscard]] auto Guarded(std::string_view thread, Body&& body) {
  using Returned = std::invoke_result_t<Body>;
  using Ended = std::conditional_t<std::is_void_v<Returned>, Result<void>, Returned>;
  const auto failed = [&](std::string_view what) -> Ended {
    return Fail(ErrorCode::kInternal,
                "{} has failed ({}): this is a fault of the program; please report it with its log",
                thread, what);
  };
  try {
    if constexpr (std::is_void_v<Returned>) {
      std::forward<Body>(body)();
      return Ended();
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
