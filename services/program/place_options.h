#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "services/route/route.h"

namespace trailcast::program {

// Adds --<stem>-site X,Y and --<stem>-gps LAT,LON, of which one may be given; `place`, which must
// outlive the parsing, is then set. `what` begins their help: "Where the route begins".
void AddPlaceOptions(CLI::App& app, const std::string& stem, const std::string& what,
                     std::optional<route::Place>& place);

}  // namespace trailcast::program
