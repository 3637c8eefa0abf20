#pragma once

#include <optional>
#include <string>

#include "services/users/user.h"

namespace trailcast::console {

// This is what the API allows to which users. rights.cc has the one table of it.
struct Right {
  bool is_known = false;  // false for requests that are not in the table, which nobody may make
  std::optional<users::Role> needs{};  // empty for everyone, logged in or not
};
[[nodiscard]] Right RightTo(const std::string& method, const std::string& path);
// Returns the methods that the path takes, as the header Allow has them: "GET, POST". It is empty
// if there is no such path.
[[nodiscard]] std::string MethodsOf(const std::string& path);

}  // namespace trailcast::console
