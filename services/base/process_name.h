#pragma once

#include <string>

namespace trailcast {

// Returns a member's name followed by a process's number, such as "desk-p4711". A member's commands
// run under such names beside its agent and beside each other. No member may be named so.
[[nodiscard]] std::string ProcessName(const std::string& member, long process);
// Returns the member that such a name belongs to; any other name stays as it is.
[[nodiscard]] std::string WithoutProcess(const std::string& name);

}  // namespace trailcast
