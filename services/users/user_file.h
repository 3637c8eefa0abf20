#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "services/base/result.h"
#include "services/users/user.h"

namespace trailcast::users {

// kNotFound: there is no such file; kCorrupt: it is none of users.
[[nodiscard]] Result<Users> LoadUsers(const std::filesystem::path& file);

// Changes the file, or makes it, for its owner alone, which, of root's, is the folder's. Two who
// change it at the same time do so one after the other; nothing is written where `change` fails.
[[nodiscard]] Result<void> ChangeUsers(const std::filesystem::path& file,
                                       const std::function<Result<void>(Users&)>& change);

// The file's users, also once it has changed. One that cannot be read any more changes nothing:
// who has to stop a robot is not to be locked out by a slip of the pen.
class WatchedUsers {
 public:
  using Time = std::chrono::steady_clock::time_point;
  static constexpr std::chrono::milliseconds kLookEvery{500};

  WatchedUsers(std::filesystem::path file, Users users);

  // What is wrong with the file is told to `complain`, once.
  [[nodiscard]] const Users& At(Time now, const std::function<void(const Error&)>& complain);

 private:
  [[nodiscard]] std::string Version() const;

  std::filesystem::path file_;
  Users users_;
  std::string version_;
  std::optional<Time> looked_at_;
};

}  // namespace trailcast::users
