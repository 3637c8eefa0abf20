#pragma once

#include <vector>

#include "services/tool/commands/command.h"

namespace trailcast::tool {

// Adds the subcommands of `trailcast routes` that change what followers are offered, and what
// routes are called. `common` and `timeout_s` are filled before they run, and outlive them.
[[nodiscard]] std::vector<Command> AddRouteEdits(CLI::App& routes,
                                                 const program::CommonOptions& common,
                                                 const double& timeout_s);

}  // namespace trailcast::tool
