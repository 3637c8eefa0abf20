#pragma once

#include <CLI/CLI.hpp>
#include <istream>
#include <vector>

namespace trailcast::program {

// Reads TOML as CLI11 does, with comments wherever TOML allows them. CLI11 2.1 takes a comment
// behind a section's header for part of its name, and a '#' in a quoted value for a comment. A key
// that a section has twice, of which CLI11 takes the first, is an error, as in TOML.
class Toml : public CLI::ConfigTOML {
 public:
  [[nodiscard]] std::vector<CLI::ConfigItem> from_config(std::istream& input) const override;
};

}  // namespace trailcast::program
