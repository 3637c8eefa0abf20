#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace trailcast::program {

// Makes `--help` explain what a first user needs: the options of kFirstGroup, a command's own and
// those that it shares with others. It only lists the names of other groups; `--help-all` explains
// them, too.
class ShortHelp : public CLI::Formatter {
 public:
  std::string make_help(const CLI::App* app, std::string name,
                        CLI::AppFormatMode mode) const override;

 private:
  [[nodiscard]] std::string Explained(const CLI::App& app, CLI::AppFormatMode mode) const;
};

}  // namespace trailcast::program
