#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace trailcast::console {

// This is `trailcast-console users`: add, list, remove, passwd.
class UsersCommand {
 public:
  explicit UsersCommand(CLI::App& app);

  // Returns whether the parsed command line asks for this. Run then does it and returns the exit
  // status.
  [[nodiscard]] bool asked_for() const { return command_->parsed(); }
  [[nodiscard]] int Run() const;

 private:
  CLI::App* command_;
  CLI::App* add_ = nullptr;
  CLI::App* list_ = nullptr;
  CLI::App* remove_ = nullptr;
  CLI::App* passwd_ = nullptr;
  std::string file_ = "console-users";
  std::string name_;
  std::string role_;
  bool token_ = false;
};

}  // namespace trailcast::console
