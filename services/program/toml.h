#pragma once

#include <CLI/CLI.hpp>
#include <istream>
#include <vector>

namespace trailcast::program {

// TOML as CLI11 reads it, and with comments wherever TOML allows them: CLI11 2.1 takes one behind a
// section's header for part of its name, and a '#' in a quoted value for a comment.
class Toml : public CLI::ConfigTOML {
 public:
  [[nodiscard]] std::vector<CLI::ConfigItem> from_config(std::istream& input) const override;
};

}  // namespace trailcast::program
