#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "services/route/route.h"

namespace trailcast::program {

// Adds --<stem>-site X,Y and --<stem>-gps LAT,LON, of which only one may be given and then sets
// `place`, which must outlive the parsing. Their help begins with `what`: "Where the route begins".
void AddPlaceOptions(CLI::App& app, const std::string& stem, const std::string& what,
                     std::optional<route::Place>& place);

}  // namespace trailcast::program
