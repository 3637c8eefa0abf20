#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "services/base/result.h"
#include "services/route/codec.h"
#include "services/route/route.h"

namespace trailcast::route {

// These are the bounds on a route, wherever it comes from: a peer, a file or a store's row. Routes
// that are made keep to them, too. docs/reference/protocol.md has them for other programs.
inline constexpr std::uint64_t kMaxTeaching = (1ULL << 63U) - 1;  // a database's largest integer
inline constexpr std::uint32_t kMaxSegmentsPerRoute = 100'000;    // 200 km of 2 m segments
inline constexpr std::uint64_t kMaxRouteBytes =
    kMaxSegmentsPerRoute * std::uint64_t{kMaxSegmentBytes};
inline constexpr std::size_t kMaxCameraBytes = 128;
inline constexpr int kMaxImageSide_px = 65535;
inline constexpr double kMaxLength_m = 1e7;

// Fails with kInvalidArgument, which names the field, its value and what is accepted.
[[nodiscard]] Result<void> CheckInfo(const RouteInfo& info);

// These check one field in the same way. The error calls it `field`.
[[nodiscard]] Result<void> CheckName(const char* field, const std::string& name);
[[nodiscard]] Result<void> CheckText(const char* field, const std::string& text,
                                     std::size_t max_bytes);
[[nodiscard]] Result<void> CheckCount(const char* field, std::uint64_t count, std::uint64_t max);
// Checks an enumeration whose values count from 0.
template <typename Enum>
[[nodiscard]] Result<void> CheckEnum(const char* field, Enum value, Enum last) {
  return CheckCount(field, static_cast<std::uint8_t>(value), static_cast<std::uint8_t>(last));
}
// Checks that a value is a number from 0 to `max`.
[[nodiscard]] Result<void> CheckAmount(const char* field, double value, double max);
[[nodiscard]] Result<void> CheckKey(const RouteKey& key);
[[nodiscard]] Result<void> CheckState(RouteState state);
[[nodiscard]] Result<void> CheckStanding(Standing standing);
[[nodiscard]] Result<void> CheckTags(const std::vector<std::string>& tags);  // in any order
[[nodiscard]] Result<void> CheckPlace(const Place& place);

}  // namespace trailcast::route
