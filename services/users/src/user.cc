#include "services/users/user.h"

#include <array>
#include <vector>

#include "services/base/ids.h"
#include "services/users/secret.h"

namespace trailcast::users {
namespace {

constexpr std::array kRoles{Role::kLook, Role::kOperate, Role::kAdminister};
constexpr std::string_view kNone = "-";

std::vector<std::string_view> Fields(std::string_view line) {
  std::vector<std::string_view> fields;
  while (true) {
    const std::size_t from = line.find_first_not_of(' ');
    if (from == std::string_view::npos) return fields;
    line.remove_prefix(from);
    const std::size_t to = std::min(line.find(' '), line.size());
    fields.push_back(line.substr(0, to));
    line.remove_prefix(to);
  }
}

// Adds the user of one line, or returns what is wrong with it.
std::string Read(std::string_view line, Users& users) {
  const auto fields = Fields(line);
  if (fields.size() != 4) return "is not 'NAME ROLE PASSWORD TOKEN'";
  const std::string name(fields[0]);
  if (!IsUserName(name)) return "has no name of 1 to 32 letters, digits, '_', '.', '-'";
  const auto role = FindRole(fields[1]);
  if (!role) return "has a role that is none of look, operate, administer";
  User user{.role = *role};
  if (fields[2] != kNone) user.password = fields[2];
  if (fields[3] != kNone) user.token = fields[3];
  if (!user.password.empty() && !IsPasswordHash(user.password)) return "has no password's hash";
  if (!user.token.empty() && !IsDigest(user.token)) return "has no token's digest";
  if (!users.emplace(name, std::move(user)).second) return "names a user for the second time";
  return users.size() > kMostUsers ? "is one user too many" : "";
}

}  // namespace

const char* NameOf(Role role) {
  switch (role) {
    case Role::kLook:
      return "look";
    case Role::kOperate:
      return "operate";
    case Role::kAdminister:
      return "administer";
  }
  return "unknown role";
}

std::optional<Role> FindRole(std::string_view name) {
  for (const Role role : kRoles) {
    if (name == NameOf(role)) return role;
  }
  return std::nullopt;
}

bool IsUserName(const std::string& name) {
  return name.size() <= kLongestName && IsValidName(name);
}

Result<Users> ParseUsers(std::string_view text) {
  Users users;
  for (std::size_t number = 1; !text.empty(); ++number) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    if (line.empty() || line.front() == '#') continue;
    if (const std::string wrong = Read(line, users); !wrong.empty()) {
      return Fail(ErrorCode::kCorrupt, "line {} {}", number, wrong);
    }
  }
  return users;
}

std::string TextOf(const Users& users) {
  const auto or_none = [](const std::string& text) {
    return text.empty() ? kNone : std::string_view(text);
  };
  std::string text = "# NAME ROLE PASSWORD TOKEN, written by 'trailcast-console users'\n";
  for (const auto& [name, user] : users) {
    text += fmt::format("{} {} {} {}\n", name, NameOf(user.role), or_none(user.password),
                        or_none(user.token));
  }
  return text;
}

}  // namespace trailcast::users
