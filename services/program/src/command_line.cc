#include "services/program/command_line.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <utility>
#include <vector>

#include "services/base/ids.h"
#include "services/base/similar_names.h"
#include "services/program/src/short_help.h"
#include "services/program/toml.h"
#include "services/security/member_keys.h"

#ifndef TRAILCAST_VERSION
#error "TRAILCAST_VERSION comes from CMake"
#endif

namespace trailcast::program {
namespace {

constexpr const char* kItself = "The program itself";

// Returns the keys that a configuration file may have for `app` itself.
std::string Keys(const CLI::App& app) {
  std::vector<std::string> keys;
  for (const CLI::Option* option : app.get_options()) {
    if (option->get_configurable() && !option->get_lnames().empty()) {
      keys.push_back(option->get_lnames().front());
    }
  }
  return fmt::format("{}", fmt::join(keys, ", "));
}

std::string AcceptedKeys(const CLI::App& app) {
  std::string text = fmt::format("accepted keys: {}", Keys(app));
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    text += fmt::format("\n  in [{}]: {}", command->get_name(), Keys(*command));
  }
  return text;
}

// These are the names that commands and options had once.
constexpr std::pair<const char*, const char*> kFormerNames[] = {
    {"glance", "snapshot"},
    {"joints", "junctions"},
    {"--joints", "--junctions"},
    {"--joints-auto", "--junctions-auto"}};

void AddOptionNames(const CLI::App& app, std::vector<std::string>& names) {
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
}

// Returns "; did you mean 'snapshot'?" for what is no command or option of `app`, or an empty text.
std::string NameLike(const CLI::App& app, const std::string& unknown) {
  const std::string word = unknown.substr(0, unknown.find('='));
  std::vector<std::string> names;
  AddOptionNames(app, names);
  for (const CLI::App* command : app.get_subcommands()) AddOptionNames(*command, names);
  if (app.get_subcommands().empty()) {
    for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
      names.push_back(command->get_name());
    }
  }
  for (const auto& [former, present] : kFormerNames) {
    const bool is_there = std::find(names.begin(), names.end(), present) != names.end();
    if (word == former && is_there) return fmt::format("; did you mean '{}'?", present);
  }
  return DidYouMean(word, std::move(names));
}

// CLI11 looks for missing options before superfluous ones, but a misspelt option is both.
std::string Explain(const CLI::App& app, const CLI::ParseError& error) {
  std::string message = error.what();
  const std::vector<std::string> unknown = app.remaining(true);
  if (!unknown.empty()) {
    return fmt::format("not understood: {}{}", fmt::join(unknown, " "),
                       NameLike(app, unknown.front()));
  }
  if (dynamic_cast<const CLI::ConfigError*>(&error) == nullptr) return message;
  const std::string prefix = "INI was not able to parse ";
  if (message.rfind(prefix, 0) != 0) return message;
  std::string key = message.substr(prefix.size());
  constexpr const char* kBegins = ".++";  // CLI11's item for the beginning of a section
  const bool section = key.ends_with(kBegins);
  if (section) key = fmt::format("[{}]", key.substr(0, key.size() - std::strlen(kBegins)));
  constexpr std::size_t kMostShown = 100;
  if (key.size() > kMostShown) key = key.substr(0, kMostShown) + "...";
  return fmt::format("the configuration file has a {} '{}' that is not known; {}",
                     section ? "section" : "key", key, AcceptedKeys(app));
}

// CLI11's ranges let NaN pass, because it is neither below nor above them.
void RefuseWhatIsNoNumber(CLI::App& app) {
  const CLI::Validator finite(
      [](std::string& text) {
        if (std::isfinite(std::strtod(text.c_str(), nullptr))) return std::string();
        return fmt::format("'{}' is no number that can be used", text);
      },
      "");
  for (CLI::Option* option : app.get_options()) {
    if (option->get_type_name().starts_with("FLOAT")) option->check(finite);
  }
  for (CLI::App* command : app.get_subcommands([](CLI::App*) { return true; })) {
    RefuseWhatIsNoNumber(*command);
  }
}

}  // namespace

const char* Version() { return TRAILCAST_VERSION; }

void AddCommonOptions(CLI::App& app, CommonOptions& options) {
  app.formatter(std::make_shared<ShortHelp>());
  app.set_help_all_flag("--help-all", "Explain all options, and exit");
  app.set_version_flag("--version", fmt::format("{} {}", app.get_name(), Version()))
      ->group(kItself);
  app.set_config("--config", "", "TOML file with any of these options; unknown keys are errors")
      ->group(kItself);
  app.config_formatter(std::make_shared<Toml>());
  app.allow_config_extras(CLI::config_extras_mode::error);
  app.option_defaults()->always_capture_default();
  CLI::Option* name = app.add_option("--name", options.name,
                                     "Name in the fleet, unique: letters, digits, '_', '.', '-'");
  name->check(NameValidator())->envname("TRAILCAST_NAME");
  app.option_defaults()->group("Network");
  app.add_option("--domain", options.domain, "DDS domain; only processes of one domain meet")
      ->check(CLI::Range(0, 230))
      ->envname("TRAILCAST_DOMAIN");
  app.add_option("--dds-tag", options.dds_tag,
                 "DDS domain tag: processes with other tags do not meet either")
      ->envname("TRAILCAST_DDS_TAG");
  app.add_option("--network-interface", options.network_interface,
                 "Network interface for DDS, as 'lo' or 'wlan0'; empty: the best that is up and "
                 "has an IPv4 address, never 'lo'")
      ->envname("TRAILCAST_NETWORK_INTERFACE");
  app.add_option("--discovery", options.discovery,
                 "Whom to meet: 'star' the route servers alone, 'mesh' everybody, which costs "
                 "large fleets much, 'auto' everybody as long as there is no server; servers are "
                 "met either way")
      ->check(CLI::IsMember({"auto", "star", "mesh"}))
      ->envname("TRAILCAST_DISCOVERY");
  app.add_option("--server-address", options.server_addresses,
                 "Names or IPv4 addresses of route servers, as 'a,b', where there is no multicast: "
                 "UDP ports 7410 and 7411, 250 more for each domain above 0")
      ->delimiter(',')
      ->envname("TRAILCAST_SERVER_ADDRESS");
  app.add_option("--security", options.security,
                 "Folder with this member's keys, as 'trailcast keys add' wrote it: speaks, "
                 "encrypted, with members of its fleet only; empty: open to everybody")
      ->envname("TRAILCAST_SECURITY");
  app.final_callback([&options, name] {
    if (options.security.empty() || name->count() > 0) return;
    // Keys that are wrong are reported when the program joins with them.
    if (const auto in_keys = security::NameInKeys(options.security)) options.name = *in_keys;
  });
  app.option_defaults()->group(kItself);
  app.add_option("--log-level", options.log_level, "What is told on stderr")
      ->check(CLI::IsMember({"trace", "debug", "info", "warn", "error", "off"}))
      ->envname("TRAILCAST_LOG_LEVEL");
  app.add_option("--log-format", options.log_format,
                 "Lines for people, or a JSON object a line for programs")
      ->check(CLI::IsMember({"text", "json"}))
      ->envname("TRAILCAST_LOG_FORMAT");
  app.option_defaults()->group(kFirstGroup);
}

std::optional<int> Parse(CLI::App& app, int argc, char** argv) {
  RefuseWhatIsNoNumber(app);
  try {
    app.parse(argc, argv);
    return std::nullopt;
  } catch (const CLI::Success& shown) {
    return app.exit(shown);
  } catch (const CLI::ParseError& error) {
    fmt::print(stderr, "{}: {}\nTry '{} --help'.\n", app.get_name(), Explain(app, error),
               app.get_name());
    return kExitUsage;
  }
}

CLI::Validator RevisionValidator() {
  return {[](std::string& text) {
            const bool digits = !text.empty() && text.size() <= 9 &&
                                text.find_first_not_of("0123456789") == std::string::npos;
            if (digits && text.find_first_not_of('0') != std::string::npos) return std::string();
            return fmt::format("'{}' is no revision: expected a whole number from 1", text);
          },
          "REVISION"};
}

CLI::Validator NameValidator() {
  return {[](std::string& name) {
            if (IsValidName(name)) return std::string{};
            return fmt::format("'{}' is no name: 1 to 64 of letters, digits, '_', '.' and '-'",
                               name);
          },
          "NAME"};
}

CLI::Validator RouteRefValidator() {
  return {[](std::string& text) {
            const auto ref = route::ParseRouteRef(text);
            return ref ? std::string() : ref.error().message;
          },
          "NAME|ID[@REVISION]"};
}

Result<route::RouteRef> WithRevision(const std::string& route, std::uint32_t revision) {
  auto ref = route::ParseRouteRef(route);
  if (!ref || revision == 0) return ref;
  if (ref->revision != 0 && ref->revision != revision) {
    return Fail(ErrorCode::kInvalidArgument, "'{}' is revision {}, and --revision says {}", route,
                ref->revision, revision);
  }
  ref->revision = revision;
  return ref;
}

int Complain(const CLI::App& app, const Error& error) {
  fmt::print(stderr, "{}: {}\n", app.get_name(), error.message);
  return kExitFailure;
}

}  // namespace trailcast::program
