#pragma once

#include <optional>
#include <string>

#include "services/users/user.h"

namespace trailcast::console {

// What the API lets whom do: the one table of it is in rights.cc.
struct Right {
  bool is_known = false;               // what is not in the table is nobody's right
  std::optional<users::Role> needs{};  // null: anybody, logged in or not
};
[[nodiscard]] Right RightTo(const std::string& method, const std::string& path);
// Returns the methods that the path takes, as the header Allow has them: "GET, POST". Empty: there
// is no such path.
[[nodiscard]] std::string MethodsOf(const std::string& path);

}  // namespace trailcast::console
