#pragma once

#include <fmt/format.h>

#include <string>
#include <tl/expected.hpp>
#include <utility>

namespace trailcast {

// What kind of thing went wrong, for callers that react differently. The message is for people.
enum class ErrorCode {
  kInvalidArgument,  // what the caller or the user gave cannot be used
  kNotFound,         // no such file, route, segment
  kCorrupt,          // bytes that fail their digest or cannot be decoded
  kConflict,         // contradicts what is already there (same segment, other bytes; name taken)
  kUnavailable,      // disk full, no server, network down: may work later
  kInternal,         // a library refused something that should have worked
};

struct Error {
  ErrorCode code = ErrorCode::kInternal;
  // What was wrong, what was expected, what to do. One line, no final newline.
  std::string message;
};

template <typename T>
using Result = tl::expected<T, Error>;

template <typename... Args>
[[nodiscard]] tl::unexpected<Error> Fail(ErrorCode code, fmt::format_string<Args...> format,
                                         Args&&... args) {
  return tl::unexpected<Error>(Error{code, fmt::format(format, std::forward<Args>(args)...)});
}

// Passes an error on, with what was being done put before it.
[[nodiscard]] inline tl::unexpected<Error> Wrap(const Error& error, const std::string& doing) {
  return tl::unexpected<Error>(Error{error.code, doing + ": " + error.message});
}

}  // namespace trailcast
