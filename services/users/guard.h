#pragma once

#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "services/base/newest_map.h"
#include "services/base/result.h"
#include "services/users/secret.h"
#include "services/users/sessions.h"
#include "services/users/throttle.h"
#include "services/users/user_file.h"

namespace trailcast::users {

struct Who {
  std::string name{};  // empty if no name was required
  Role role = Role::kLook;
};

// The reason for which a log-in was refused.
struct Turned {
  enum class Why { kWrong, kTooOften, kBusy } why = Why::kWrong;
  std::chrono::milliseconds wait{0};  // for kTooOften
};

// Logs users in and recognises them afterwards. Any thread may call it. LogIn hashes one password
// at a time, on a thread of low priority, and nothing else waits for that.
class Guard {
 public:
  using Time = std::chrono::steady_clock::time_point;
  using Complain = std::function<void(const Error&)>;
  struct Parts {
    std::function<Time()> clock = [] { return std::chrono::steady_clock::now(); };
    std::function<bool(const std::string& password, const std::string& hash)> matches = Matches;
  };
  static constexpr int kMostWaiting = 6;  // users who wait for their password to be hashed

  // Errors: kNotFound and kCorrupt, as LoadUsers has them, also if the file has no users.
  // `complain` is called if the file cannot be read later.
  [[nodiscard]] static Result<std::unique_ptr<Guard>> Open(const std::filesystem::path& file,
                                                           Complain complain, Parts parts);
  [[nodiscard]] static Result<std::unique_ptr<Guard>> Open(const std::filesystem::path& file,
                                                           Complain complain) {
    return Open(file, std::move(complain), Parts{});
  }

  // Returns a session's token. `address` is the user's; of an IPv6 address it is the network.
  [[nodiscard]] std::variant<std::string, Turned> LogIn(const std::string& name,
                                                        const std::string& password,
                                                        const std::string& address);
  void LogOut(const std::string& session);
  [[nodiscard]] std::optional<Who> WhoIn(const std::string& session);
  // Returns the users that the file has now, or changes them there (user_file.h). A user
  // who is removed, or has another password, is out once the file is looked at again.
  [[nodiscard]] Result<Users> List() const { return LoadUsers(file_); }
  [[nodiscard]] Result<void> Change(const std::function<Result<void>(Users&)>& change) const {
    return ChangeUsers(file_, change);
  }
  // Returns the user of a program's token.
  [[nodiscard]] std::optional<Who> WhoseToken(const std::string& token);

 private:
  Guard(const std::filesystem::path& file, Users users, Complain complain, Parts parts);
  [[nodiscard]] const Users& Known(Time now) { return users_.At(now, complain_); }
  [[nodiscard]] std::optional<Turned> MustWait(const std::string& name, const std::string& address);

  const std::filesystem::path file_;
  Complain complain_;
  Parts parts_;
  std::mutex mutex_;  // guards everything below
  WatchedUsers users_;
  Sessions sessions_;
  Throttle of_address_;
  Throttle of_name_;
  NewestMap<std::pair<std::string, std::string>, bool> known_{kMostUsers};  // name, address
  int waiting_ = 0;
  bool hashes_ = false;
  std::condition_variable hashed_;
};

}  // namespace trailcast::users
