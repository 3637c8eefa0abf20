#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "services/mission/address.h"

namespace trailcast::tool {

// Takes whom a mission or a command may be for (mission/address.h).
[[nodiscard]] inline CLI::Validator AddressValidator() {
  return {[](std::string& text) {
            const auto addressed = mission::ParseAddress(text);
            return addressed ? std::string() : addressed.error().message;
          },
          "NAME|@GROUP"};
}

}  // namespace trailcast::tool
