#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "services/program/json.h"
#include "services/security/authority.h"
#include "services/security/revocation_list.h"
#include "services/tool/commands/command.h"
#include "services/tool/keys_report.h"

namespace trailcast::tool {
namespace {

namespace fs = std::filesystem;
using security::Authority;

constexpr int kAuthorityDays = 3650;
constexpr int kMemberDays = 365;
constexpr int kMostDays = 36500;

struct KeysOptions {
  std::string authority = "trailcast-keys";
  std::string folder;  // of the authority to create or to examine
  std::string name;
  std::string role;
  int authority_days = kAuthorityDays;
  int days = kMemberDays;
  bool json = false;
};

constexpr const char* kKeysExamples =
    "Examples:\n"
    "  trailcast keys init fleet                       # once: the fleet's authority\n"
    "  export TRAILCAST_AUTHORITY=fleet\n"
    "  trailcast keys add --role server server\n"
    "  trailcast keys add --role scout robot1\n"
    "  scp -r fleet/members/robot1 robot1:keys         # and there: trailcast-agent ... --security "
    "keys\n"
    "  trailcast keys renew robot1                     # before they expire: new keys, copied "
    "again\n"
    "  trailcast keys revoke robot1                    # stolen: copy fleet/revoked.pem to the "
    "server's keys\n"
    "  trailcast keys list\n"
    "  trailcast keys revocations keys                 # which list of revoked keys a folder "
    "holds\n"
    "The folder stays on one machine, a safe one: who has authority.key in it can make members.\n"
    "Running programs take up changed files in their keys' folder within seconds; a route server\n"
    "gives a new list of revoked keys to all members, at once or when they meet it.";

constexpr const char* kRoles =
    "Roles:\n"
    "  server    stores and serves routes\n"
    "  scout     teaches routes, and may follow\n"
    "  follower  follows routes; what it lends to others is believed only where it can be proven\n"
    "  operator  changes, retires and deletes routes, imports and exports them\n"
    "  observer  looks: trailcast routes, trailcast where";

security::Time Now() { return std::chrono::system_clock::now(); }

int Told(const CLI::App& app, const Result<void>& done) {
  return done ? program::kExitOk : program::Complain(app, done.error());
}

Result<void> Init(const KeysOptions& options) {
  const fs::path folder = options.folder.empty() ? options.authority : options.folder;
  const auto authority = Authority::Create(folder, Now(), options.authority_days);
  if (!authority) return tl::unexpected(authority.error());
  fmt::print(
      "{}: a new authority. Keep the folder where it is, {} above all.\n"
      "Next: trailcast keys add --authority {} --role server NAME\n",
      folder.string(), (folder / "authority.key").string(), folder.string());
  return {};
}

void TellGiven(const fs::path& folder) {
  fmt::print(
      "{}: copy this folder to that member's machine, and give it to its program with --security\n",
      folder.string());
}

Result<void> Add(const KeysOptions& options) {
  const auto authority = Authority::Open(options.authority);
  if (!authority) return tl::unexpected(authority.error());
  const auto given =
      authority->Add(options.name, *security::FindRole(options.role), Now(), options.days);
  if (!given) return tl::unexpected(given.error());
  TellGiven(*given);
  return {};
}

void TellRevoked(const Authority& authority) {
  fmt::print(
      "Copy {} into the keys' folder of a route server: it gives it to all members, and each keeps "
      "it out from then on\n",
      authority.RevocationFile().string());
}

Result<void> Renew(const KeysOptions& options) {
  const auto authority = Authority::Open(options.authority);
  if (!authority) return tl::unexpected(authority.error());
  const auto role = options.role.empty() ? std::nullopt : security::FindRole(options.role);
  const auto given = authority->Renew(options.name, role, Now(), options.days);
  if (!given) return tl::unexpected(given.error());
  TellGiven(*given);
  if (role) {
    fmt::print("The keys of its role before are revoked. ");
    TellRevoked(*authority);
  }
  return {};
}

Result<void> Revoke(const KeysOptions& options) {
  const auto authority = Authority::Open(options.authority);
  if (!authority) return tl::unexpected(authority.error());
  if (auto revoked = authority->Revoke(options.name, Now()); !revoked) return revoked;
  fmt::print("{} is revoked. ", options.name);
  TellRevoked(*authority);
  return {};
}

Result<void> List(const KeysOptions& options) {
  const auto authority = Authority::Open(options.authority);
  if (!authority) return tl::unexpected(authority.error());
  const auto rows = authority->List(Now());
  if (!rows) return tl::unexpected(rows.error());
  std::fputs((options.json ? program::Indented(KeysJson(*rows)) : KeysTable(*rows)).c_str(),
             stdout);
  return {};
}

Result<void> Revocations(const KeysOptions& options) {
  const fs::path folder = options.folder.empty() ? options.authority : options.folder;
  const auto list = security::RevocationListIn(folder);
  if (!list) return tl::unexpected(list.error());
  fmt::print("{}: {}\n", folder.string(), security::Describe(*list));
  return {};
}

std::vector<std::string> RoleNames() {
  std::vector<std::string> names;
  for (const security::Role role : security::AllRoles()) names.emplace_back(NameOf(role));
  return names;
}

void AddName(CLI::App& command, KeysOptions& options) {
  command.add_option("NAME", options.name, "The member's name in the fleet")
      ->required()
      ->check(program::NameValidator());
}

void AddDays(CLI::App& command, int& days, const char* help) {
  command.add_option("--days", days, help)->check(CLI::Range(1, kMostDays))->capture_default_str();
}

}  // namespace

Command AddKeysCommand(CLI::App& parent) {
  auto options = std::make_shared<KeysOptions>();
  CLI::App* app = parent.add_subcommand(
      "keys", "Who belongs to the fleet and what each may do: keys for --security");
  app->footer(kKeysExamples);
  app->require_subcommand(1);
  app->add_option("--authority", options->authority, "Folder of the fleet's authority")
      ->capture_default_str()
      ->envname("TRAILCAST_AUTHORITY");
  using Job = Result<void> (*)(const KeysOptions&);
  std::vector<std::pair<CLI::App*, Job>> jobs;
  const auto add = [&](const char* name, const char* help, Job job) {
    CLI::App* command = app->add_subcommand(name, help);
    command->fallthrough();
    jobs.emplace_back(command, job);
    return command;
  };
  CLI::App* init = add("init", "Make a fleet's authority, in a new folder", &Init);
  init->add_option("DIR", options->folder, "Default: the folder of --authority");
  AddDays(*init, options->authority_days, "How long it holds, and all it signs");

  CLI::App* member = add("add", "Make keys for a new member", &Add);
  member->footer(kRoles);
  member->add_option("--role", options->role, "What it may do")
      ->required()
      ->check(CLI::IsMember(RoleNames()));
  AddName(*member, *options);
  AddDays(*member, options->days, "How long they hold");

  CLI::App* renew = add("renew", "Make new keys for a member; takes revoked ones back", &Renew);
  renew->add_option("--role", options->role, "Another role; its earlier keys are then revoked")
      ->check(CLI::IsMember(RoleNames()));
  AddName(*renew, *options);
  AddDays(*renew, options->days, "How long they hold");

  AddName(*add("revoke", "Have nobody believe a member any more", &Revoke), *options);
  add("list", "Show the members", &List)->add_flag("--json", options->json, "For programs");
  add("revocations", "Show which list of revoked keys a folder holds", &Revocations)
      ->add_option("DIR", options->folder,
                   "A member's keys, or an authority; default: the folder of --authority");
  return {app, [options, jobs] {
            for (const auto& [command, job] : jobs) {
              if (command->parsed()) return Told(*command, job(*options));
            }
            return program::kExitUsage;
          }};
}

}  // namespace trailcast::tool
