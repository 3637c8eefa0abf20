#include "services/console/users_command.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <utility>

#include "services/console/password.h"
#include "services/program/command_line.h"
#include "services/users/secret.h"
#include "services/users/user_file.h"

namespace trailcast::console {
namespace {

using users::User;
using users::Users;

constexpr const char* kFooter = R"(Roles:
  look        sees everything, and tells robots nothing
  operate     sends, pauses, stops robots
  administer  changes routes and users, too
A password is asked for on the terminal, or read as one line from standard input. A token is for programs:
shown once, and sent by them as 'Authorization: Bearer TOKEN'.
Examples:
  trailcast-console users add anna --role operate
  trailcast-console users add warehouse --role operate --token
  trailcast-console --users console-users
A console that runs takes up changes at once; who is removed is out.)";

CLI::Validator UserNameValidator() {
  return {[](const std::string& name) -> std::string {
            if (users::IsUserName(name)) return "";
            return "'" + name + "' is no name: 1 to 32 of letters, digits, '_', '.' and '-'";
          },
          "NAME"};
}

// Asks for a password and returns its hash.
Result<std::string> NewPassword(const std::string& name) {
  auto password = ReadPassword(fmt::format("Password for {}: ", name));
  if (!password) return password;
  if (auto fits = users::CheckPassword(name, *password); !fits) {
    return tl::unexpected(fits.error());
  }
  if (isatty(STDIN_FILENO) != 0) {
    auto again = ReadPassword("The same again: ");
    if (!again) return again;
    if (*again != *password) {
      return Fail(ErrorCode::kInvalidArgument, "these were two different passwords");
    }
  }
  return users::HashPassword(*password);
}

tl::unexpected<Error> NoSuchUser(const std::string& name, const std::string& file) {
  return Fail(ErrorCode::kNotFound, "there is no user '{}' in {}", name, file);
}

Result<void> Add(const std::string& file, const std::string& name, users::Role role, bool token) {
  const auto is_there = [&](const Users& users) -> Result<void> {
    if (!users.contains(name)) return {};
    return Fail(ErrorCode::kConflict, "there is a user '{}' in {} already: remove it first", name,
                file);
  };
  // This comes before a person thinks up a password.
  if (std::filesystem::exists(file)) {
    const auto users = users::LoadUsers(file);
    if (!users) return tl::unexpected(users.error());
    if (auto free = is_there(*users); !free) return free;
  }
  User user{.role = role};
  const std::string drawn = token ? users::DrawToken() : "";
  if (token) {
    user.token = users::DigestOf(drawn);
  } else {
    auto password = NewPassword(name);
    if (!password) return tl::unexpected(password.error());
    user.password = *std::move(password);
  }
  auto added = users::ChangeUsers(file, [&](Users& users) {
    auto free = is_there(users);
    if (free) users[name] = user;
    return free;
  });
  if (!added) return added;
  fmt::print(stderr, "{} may {}. Start the console with: --users {}\n", name, NameOf(role),
             std::filesystem::absolute(file).string());
  if (token) fmt::print("{}\n", drawn);
  return {};
}

Result<void> List(const std::string& file) {
  const auto users = users::LoadUsers(file);
  if (!users) return tl::unexpected(users.error());
  for (const auto& [name, user] : *users) {
    fmt::print("{:32} {:10} {}\n", name, NameOf(user.role),
               user.token.empty() ? "password" : "token");
  }
  return {};
}

Result<void> Remove(const std::string& file, const std::string& name) {
  return users::ChangeUsers(file, [&](Users& users) -> Result<void> {
    if (users.erase(name) == 0) return NoSuchUser(name, file);
    return {};
  });
}

Result<void> SetPassword(const std::string& file, const std::string& name) {
  const auto users = users::LoadUsers(file);
  if (!users) return tl::unexpected(users.error());
  if (!users->contains(name)) return NoSuchUser(name, file);
  const auto password = NewPassword(name);
  if (!password) return tl::unexpected(password.error());
  return users::ChangeUsers(file, [&](Users& changed) -> Result<void> {
    const auto found = changed.find(name);
    if (found == changed.end()) return NoSuchUser(name, file);
    found->second.password = *password;
    return {};
  });
}

}  // namespace

UsersCommand::UsersCommand(CLI::App& app)
    : command_(app.add_subcommand("users", "Who may log in: add, list, remove, passwd")) {
  command_->footer(kFooter);
  command_->require_subcommand(1);
  add_ = command_->add_subcommand("add", "A new user, with a password or a token");
  list_ = command_->add_subcommand("list", "Users and their roles");
  remove_ = command_->add_subcommand("remove", "Whoever is logged in so is out at once");
  passwd_ = command_->add_subcommand("passwd", "Another password; who is logged in is out");
  for (CLI::App* each : {add_, list_, remove_, passwd_}) {
    if (each != list_) {
      each->add_option("name", name_, "Of the user")->required()->check(UserNameValidator());
    }
    each->add_option("--users", file_, "File of the users")->envname("TRAILCAST_USERS");
  }
  add_->add_option("--role", role_, "What the user may")
      ->required()
      ->check(CLI::IsMember({"look", "operate", "administer"}));
  add_->add_flag("--token", token_, "For a program: show a token in place of a password");
}

int UsersCommand::Run() const {
  Result<void> done;
  if (add_->parsed()) {
    done = Add(file_, name_, users::FindRole(role_).value_or(users::Role::kLook), token_);
  } else if (list_->parsed()) {
    done = List(file_);
  } else if (remove_->parsed()) {
    done = Remove(file_, name_);
  } else {
    done = SetPassword(file_, name_);
  }
  return done ? program::kExitOk : program::Complain(*command_, done.error());
}

}  // namespace trailcast::console
