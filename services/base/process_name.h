#pragma once

#include <string>

namespace trailcast {

// Commands of a member run beside its agent, and each other, under a name with their process's
// number behind: "desk-p4711". No member may be named so.
[[nodiscard]] std::string ProcessName(const std::string& member, long process);
// The member of such a name; any other name as it is.
[[nodiscard]] std::string WithoutProcess(const std::string& name);

}  // namespace trailcast
