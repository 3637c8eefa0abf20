#pragma once

#include "services/tool/commands/command.h"

namespace trailcast::tool {

// Adds `trailcast routes diff`. `common` and `timeout_s` are filled before it runs, and outlive it.
[[nodiscard]] Command AddRouteDiff(CLI::App& routes, const program::CommonOptions& common,
                                   const double& timeout_s);

}  // namespace trailcast::tool
