#pragma once

#include <fmt/format.h>

#include <string>
#include <tl/expected.hpp>
#include <utility>

namespace trailcast {

// The kind of a failure, for callers that react differently. The message is for people.
enum class ErrorCode {
  kInvalidArgument,  // the caller or the user gave something that cannot be used
  kNotFound,         // there is no such file, route or segment
  kCorrupt,          // bytes do not match their digest or cannot be decoded
  kConflict,         // this contradicts what exists (same segment with other bytes; name taken)
  kUnavailable,      // disk full, no server, network down: it may work later
  kInternal,         // a library refused something that should have worked
};

struct Error {
  ErrorCode code = ErrorCode::kInternal;
  // The message says what was wrong, what was expected and what to do, in one line without a final
  // newline.
  std::string message;
};

template <typename T>
using Result = tl::expected<T, Error>;

template <typename... Args>
[[nodiscard]] tl::unexpected<Error> Fail(ErrorCode code, fmt::format_string<Args...> format,
                                         Args&&... args) {
  return tl::unexpected<Error>(Error{code, fmt::format(format, std::forward<Args>(args)...)});
}

// Returns the error with a description of the action that failed before its message.
[[nodiscard]] inline tl::unexpected<Error> Wrap(const Error& error, const std::string& doing) {
  return tl::unexpected<Error>(Error{error.code, doing + ": " + error.message});
}

}  // namespace trailcast
