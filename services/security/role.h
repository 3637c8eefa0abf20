#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "services/exchange/route_exchange.h"

namespace trailcast::security {

// The rights of a member of the fleet. The role is in the member's certificate, and in the
// permissions that the fleet's authority signs.
enum class Role : std::uint8_t { kScout, kFollower, kServer, kOperator, kObserver };

[[nodiscard]] std::span<const Role> AllRoles();
[[nodiscard]] const char* NameOf(Role role);  // "scout"
[[nodiscard]] std::optional<Role> FindRole(std::string_view name);

// Returns the topics that the role may write and read; DDS opens no others for it. A scout may do
// what a follower may. An operator changes routes' labels, and imports and exports routes. An
// observer asks the catalog.
[[nodiscard]] exchange::TopicUse RightsOf(Role role);

// Returns what in `use` exceeds the role, as "write trailcast/routes", or an empty text.
[[nodiscard]] std::string BeyondRights(Role role, const exchange::TopicUse& use);

}  // namespace trailcast::security
