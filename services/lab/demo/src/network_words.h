#pragma once

#include <string>
#include <vector>

#include "services/program/command_line.h"

namespace trailcast::demo {

// Returns the options that put a program of that name into the demo's network.
[[nodiscard]] std::vector<std::string> NetworkWords(const program::CommonOptions& network,
                                                    const std::string& name);

}  // namespace trailcast::demo
