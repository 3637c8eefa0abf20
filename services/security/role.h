#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "services/exchange/route_exchange.h"

namespace trailcast::security {

// What a member of the fleet may do. Written into its certificate, and into the permissions that
// the fleet's authority signs for it.
enum class Role : std::uint8_t { kScout, kFollower, kServer, kOperator, kObserver };

[[nodiscard]] std::span<const Role> AllRoles();
[[nodiscard]] const char* NameOf(Role role);  // "scout"
[[nodiscard]] std::optional<Role> FindRole(std::string_view name);

// The topics that the role may write and read; DDS lets it open no others. A scout may what a
// follower may. An operator changes routes' labels, and brings routes in and out. An observer asks
// the catalog.
[[nodiscard]] exchange::TopicUse RightsOf(Role role);

// Of `use`, what the role may not: "write trailcast/routes"; empty if it may all of it.
[[nodiscard]] std::string BeyondRights(Role role, const exchange::TopicUse& use);

}  // namespace trailcast::security
