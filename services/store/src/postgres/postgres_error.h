#pragma once

#include <exception>
#include <string>

#include "services/base/result.h"

namespace trailcast::store {

// An exception of libpqxx, by what helps against it.
enum class PostgresTrouble : std::uint8_t {
  kLost,      // the connection is lost; another one may help
  kInTheWay,  // another process's transaction interfered; trying again helps
  kOther,
};
[[nodiscard]] PostgresTrouble TroubleOf(const std::exception& thrown);

// Converts it to one of our errors with what to do; `store` is its URL without the password.
[[nodiscard]] Error ToError(const std::exception& thrown, const std::string& store,
                            const std::string& doing);
// Does the same for an exception while connecting.
[[nodiscard]] Error ToConnectError(const std::exception& thrown, const std::string& store);

}  // namespace trailcast::store
