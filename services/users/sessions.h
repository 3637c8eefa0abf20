#pragma once

#include <chrono>
#include <cstddef>
#include <map>
#include <optional>
#include <string>

namespace trailcast::users {

// Who is logged in, known by a token that only their browser has. No clock of its own; not for
// several threads at once.
class Sessions {
 public:
  using Time = std::chrono::steady_clock::time_point;

  struct Limits {
    std::chrono::seconds idle{30 * 60};       // after which nobody is there any more
    std::chrono::seconds longest{12 * 3600};  // however busy
    std::size_t most = 1000;
    std::size_t of_one_user = 20;
  };
  struct Session {
    std::string user;
    std::string stamp;  // of what let the user in: another password ends it
  };

  Sessions() : Sessions(Limits{}) {}
  explicit Sessions(const Limits& limits) : limits_(limits) {}

  // Its token. Of too many, the user's own or all, the one goes that was not used for longest.
  [[nodiscard]] std::string Open(Session session, Time now);
  // Whose token it is; now it was used.
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
