#pragma once

#include <chrono>
#include <optional>
#include <string>

#include "services/security/member.h"

namespace trailcast::security {

using Time = std::chrono::system_clock::time_point;

struct Validity {
  Time from;
  Time until;
};

// Returns "2026-11-22T16:00:00Z".
[[nodiscard]] std::string ToText(Time time);

// GovernanceXml and PermissionsXml are the two documents of the DDS Security specification that the
// authority signs.

// Returns how all members protect their communication: unknown participants are kept out,
// everything is encrypted, and a topic is open only to members whose permissions allow it.
[[nodiscard]] std::string GovernanceXml();

// The topic on which servers give all members the list of revoked certificates (revocation_list.h).
// It does not belong to the exchange, because programs do not use it.
inline constexpr const char* kRevocationsTopic = "trailcast/revocations";

// Returns what one member may do: write, in its own partition and those below, and read what
// RightsOf its role has, and the revocations topic. Nothing else is allowed.
[[nodiscard]] std::string PermissionsXml(const Member& member, const Validity& validity);

// Says whether permissions allow the partitions below the member's own. Older ones do not.
[[nodiscard]] bool AllowsScopes(const std::string& permissions_xml, const Member& member);

// Says whether permissions name the topic. Permissions from before the topic existed do not.
[[nodiscard]] bool AllowsTopic(const std::string& permissions_xml, const std::string& topic);

// Returns the value of the only element of that name, or nothing if there is none or several.
[[nodiscard]] std::optional<std::string> ElementOf(const std::string& xml, const std::string& name);

}  // namespace trailcast::security
