#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "services/base/result.h"
#include "services/users/user.h"

namespace trailcast::users {

// Errors: kNotFound if there is no such file, kUnavailable if it cannot be read, kCorrupt if it has
// other than users' lines.
[[nodiscard]] Result<Users> LoadUsers(const std::filesystem::path& file);

// Changes the file, or makes it. Only its owner may read it; if root made it, it belongs to the
// folder's owner. Concurrent changes happen one after the other. Nothing is written if `change`
// fails.
[[nodiscard]] Result<void> ChangeUsers(const std::filesystem::path& file,
                                       const std::function<Result<void>(Users&)>& change);

// The users of a file, which is read again when it changes. A file that cannot be read any more
// changes nothing, because a slip of the pen must not lock out somebody who has to stop a robot.
class WatchedUsers {
 public:
  using Time = std::chrono::steady_clock::time_point;
  static constexpr std::chrono::milliseconds kLookEvery{500};

  WatchedUsers(std::filesystem::path file, Users users);

  // `complain` is called once with what is wrong with the file.
  [[nodiscard]] const Users& At(Time now, const std::function<void(const Error&)>& complain);

 private:
  [[nodiscard]] std::string Version() const;

  std::filesystem::path file_;
  Users users_;
  std::string version_;
  std::optional<Time> looked_at_;
};

}  // namespace trailcast::users
