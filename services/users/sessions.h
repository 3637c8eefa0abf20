#pragma once

#include <chrono>
#include <cstddef>
#include <map>
#include <optional>
#include <string>

namespace trailcast::users {

// The users who are logged in, each known by a token that only their browser has. It has no clock
// of its own and is not thread-safe.
class Sessions {
 public:
  using Time = std::chrono::steady_clock::time_point;

  struct Limits {
    std::chrono::seconds idle{30 * 60};       // without use
    std::chrono::seconds longest{12 * 3600};  // even in use
    std::size_t most = 1000;
    std::size_t of_one_user = 20;
  };
  struct Session {
    std::string user;
    std::string stamp;  // of the credentials that let the user in; a new password ends the session
  };

  Sessions() : Sessions(Limits{}) {}
  explicit Sessions(const Limits& limits) : limits_(limits) {}

  // Opens a session and returns its token. If the user or all users have too many, the one that was
  // unused for longest is closed.
  [[nodiscard]] std::string Open(Session session, Time now);
  // Returns the token's session, and notes that it was used now.
  [[nodiscard]] std::optional<Session> Use(const std::string& token, Time now);
  void Close(const std::string& token);
  [[nodiscard]] std::size_t size() const { return open_.size(); }

 private:
  struct Entry {
    Session session;
    Time began{};
    Time used{};
  };

  [[nodiscard]] bool IsOver(const Entry& entry, Time now) const;
  void MakeRoom(const std::string& user, Time now);

  Limits limits_;
  std::map<std::string, Entry> open_;  // by the token's digest
};

}  // namespace trailcast::users
