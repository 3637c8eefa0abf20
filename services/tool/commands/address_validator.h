#pragma once

#include <CLI/CLI.hpp>

#include "services/mission/address.h"
#include "services/program/parses_by.h"

namespace trailcast::tool {

// Takes whom a mission or a command may be for (mission/address.h).
[[nodiscard]] inline CLI::Validator AddressValidator() {
  return program::ParsesBy(mission::ParseAddress, "NAME|@GROUP");
}

}  // namespace trailcast::tool
