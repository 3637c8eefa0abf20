#pragma once

#include <string>
#include <vector>

#include "services/program/command_line.h"

namespace trailcast::demo {

// The options by which a program of that name is in the demo's network.
[[nodiscard]] std::vector<std::string> NetworkWords(const program::CommonOptions& network,
                                                    const std::string& name);

}  // namespace trailcast::demo
