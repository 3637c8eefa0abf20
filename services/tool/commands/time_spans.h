#pragma once

#include <CLI/CLI.hpp>
#include <map>
#include <string>

namespace trailcast::tool {

// Converts "90s", "20min", "2h" or "7d" to seconds. `name` stands for it in the help.
[[nodiscard]] inline CLI::Validator TimeSpan(const std::string& name) {
  const std::map<std::string, double> units = {
      {"s", 1.0}, {"min", 60.0}, {"h", 3600.0}, {"d", 86400.0}};
  return CLI::AsNumberWithUnit(units, CLI::AsNumberWithUnit::CASE_SENSITIVE, name);
}

}  // namespace trailcast::tool
