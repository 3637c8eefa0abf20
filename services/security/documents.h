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

// "2026-11-22T16:00:00Z"
[[nodiscard]] std::string ToText(Time time);

// The two documents of the DDS Security specification that the fleet's authority signs.

// How all members protect what they say: nobody takes part who is not known, what is said is
// encrypted, and every topic is open only to whom its permissions let in.
[[nodiscard]] std::string GovernanceXml();

// On which servers give all members the fleet's list of revoked certificates (revocation_list.h).
// Not one of the exchange's: programs have nothing to do with it.
inline constexpr const char* kRevocationsTopic = "trailcast/revocations";

// What one member may write, in its own partition and those below, and read (RightsOf its role),
// and of the revocations topic; nothing else.
[[nodiscard]] std::string PermissionsXml(const Member& member, const Validity& validity);

// True of permissions that allow the partitions below the member's own, as those from before there
// were any do not.
[[nodiscard]] bool AllowsScopes(const std::string& permissions_xml, const Member& member);

// True of permissions that name the topic, as those from before there was such a one do not.
[[nodiscard]] bool AllowsTopic(const std::string& permissions_xml, const std::string& topic);

// The value of the only element of that name; nothing if there is none, or several.
[[nodiscard]] std::optional<std::string> ElementOf(const std::string& xml, const std::string& name);

}  // namespace trailcast::security
