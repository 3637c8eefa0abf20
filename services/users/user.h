#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "services/base/result.h"

namespace trailcast::users {

// Each role includes those before it.
enum class Role : std::uint8_t { kLook, kOperate, kAdminister };

[[nodiscard]] const char* NameOf(Role role);  // "look"
[[nodiscard]] std::optional<Role> FindRole(std::string_view name);
[[nodiscard]] inline bool Includes(Role role, Role needed) { return role >= needed; }

struct User {
  Role role = Role::kLook;
  std::string password{};  // from HashPassword; empty means no log-in
  std::string token{};     // from DigestOf; empty means none
  bool operator==(const User&) const = default;
};

// By name.
using Users = std::map<std::string, User>;

inline constexpr std::size_t kMostUsers = 1000;
inline constexpr std::size_t kLongestName = 32;

// Says whether a name is one of the fleet's kind and not longer than kLongestName.
[[nodiscard]] bool IsUserName(const std::string& name);

// The text has a line for each user: "anna operate scrypt:.. -". kCorrupt says which line is wrong.
[[nodiscard]] Result<Users> ParseUsers(std::string_view text);
[[nodiscard]] std::string TextOf(const Users& users);

}  // namespace trailcast::users
