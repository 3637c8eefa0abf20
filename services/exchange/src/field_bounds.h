#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "services/base/result.h"
#include "services/route/route.h"

namespace trailcast::exchange {

// What bounds.h accepts, field by field. kInvalidArgument naming `field`, what it holds and what is
// accepted.
[[nodiscard]] Result<void> CheckName(const char* field, const std::string& name);
[[nodiscard]] Result<void> CheckText(const char* field, const std::string& text,
                                     std::size_t max_bytes);
[[nodiscard]] Result<void> CheckCount(const char* field, std::uint64_t count, std::uint64_t max);
// Not below 0, a number.
[[nodiscard]] Result<void> CheckAmount(const char* field, double value, double max);
[[nodiscard]] Result<void> CheckState(route::RouteState state);
[[nodiscard]] Result<void> CheckStanding(route::Standing standing);
[[nodiscard]] Result<void> CheckKey(const route::RouteKey& key);
[[nodiscard]] Result<void> CheckTags(const std::vector<std::string>& tags);

}  // namespace trailcast::exchange
