#include "services/program/src/short_help.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "services/program/command_line.h"

namespace trailcast::program {
namespace {

using Options = std::vector<const CLI::Option*>;

struct Group {
  std::string name;
  Options options;
};

// Sorts the options of `app` by group. Options that a command shares with others come without help
// flags.
std::vector<Group> GroupsOf(const CLI::App& app, bool shared) {
  std::vector<Group> groups;
  for (const std::string& name : app.get_groups()) {
    const auto options = app.get_options([&](const CLI::Option* option) {
      const bool helps = option == app.get_help_ptr() || option == app.get_help_all_ptr();
      return option->get_group() == name && option->nonpositional() && !(shared && helps);
    });
    if (!name.empty() && !options.empty()) groups.push_back({name, options});
  }
  return groups;
}

std::string NamesOf(const Group& group) {
  std::string names;
  for (const CLI::Option* option : group.options) names += " " + option->get_name();
  return fmt::format("  {}:{}\n", group.name, names);
}

}  // namespace

std::string ShortHelp::make_help(const CLI::App* app, std::string name,
                                 CLI::AppFormatMode mode) const {
  if (mode == CLI::AppFormatMode::Sub) return Formatter::make_help(app, name, mode);
  return make_description(app) + make_usage(app, name) + make_positionals(app) +
         Explained(*app, mode) + make_subcommands(app, mode) + "\n" + make_footer(app);
}

std::string ShortHelp::Explained(const CLI::App& app, CLI::AppFormatMode mode) const {
  std::vector<Group> groups = GroupsOf(app, false);
  if (app.get_parent() != nullptr) {
    for (Group& group : GroupsOf(*app.get_parent(), true)) {
      const auto same = std::find_if(groups.begin(), groups.end(),
                                     [&](const Group& own) { return own.name == group.name; });
      if (same == groups.end()) {
        groups.push_back(std::move(group));
      } else {
        same->options.insert(same->options.end(), group.options.begin(), group.options.end());
      }
    }
  }
  std::string explained;
  std::string named;
  for (const Group& group : groups) {
    if (mode == CLI::AppFormatMode::All || group.name == kFirstGroup) {
      explained += make_group(group.name, false, group.options);
    } else {
      named += NamesOf(group);
    }
  }
  if (named.empty()) return explained;
  return explained + "\nMore options, which --help-all explains:\n" + named;
}

}  // namespace trailcast::program
