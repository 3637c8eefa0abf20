#pragma once

#include <exception>
#include <string>

#include "services/base/result.h"

namespace trailcast::store {

// What libpqxx threw, sorted by what helps.
enum class PostgresTrouble : std::uint8_t {
  kLost,      // the connection: another one may help
  kInTheWay,  // another process' transaction: trying again helps
  kOther,
};
[[nodiscard]] PostgresTrouble TroubleOf(const std::exception& thrown);

// As one of our errors with what to do; `store` is its URL without the password.
[[nodiscard]] Error ToError(const std::exception& thrown, const std::string& store,
                            const std::string& doing);
// The same for what was thrown while connecting.
[[nodiscard]] Error ToConnectError(const std::exception& thrown, const std::string& store);

}  // namespace trailcast::store
