#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "services/http/server.h"
#include "services/users/guard.h"

namespace trailcast::console {

// How the console is reached, and by whom.
struct Entry {
  std::shared_ptr<users::Guard> guard{};  // null: whoever reaches it may all
  std::optional<http::Tls> tls{};
  bool behind_proxy = false;  // one that speaks TLS, and says where its clients are
  std::string only_looks{};   // why nobody gives orders here, whoever they are; empty: some may
};

// Who asks, and whether they may: a session by a cookie, for people, and a token in a header, for
// programs. Its methods may be called from any thread.
class Access {
 public:
  explicit Access(Entry entry) : entry_(std::move(entry)) {}

  // On which the console listens: browsers keep cookies of a host's ports together.
  void At(int port);
  // POST /api/log-in and /api/log-out, GET /api/me.
  void Serve(http::Server& server);

  // Why it is refused: 401 for who is not logged in, 403 for what the role may not, or another page
  // may have sent.
  [[nodiscard]] std::optional<http::Refusal> Judge(const httplib::Request& request) const;
  // Of one that was let in.
  [[nodiscard]] users::Who WhoIs(const httplib::Request& request) const;
  // Whether who sent the request still is let in, for answers that take long.
  [[nodiscard]] std::function<bool()> StillIn(const httplib::Request& request) const;
  // Strangers reach it, each from their own address.
  [[nodiscard]] bool is_open() const { return entry_.guard != nullptr && !entry_.behind_proxy; }
  [[nodiscard]] bool encrypted() const { return entry_.tls.has_value() || entry_.behind_proxy; }

 private:
  [[nodiscard]] std::optional<users::Who> Known(const httplib::Request& request) const;
  [[nodiscard]] std::string Session(const httplib::Request& request) const;
  [[nodiscard]] std::string AddressOf(const httplib::Request& request) const;
  void LogIn(const httplib::Request& request, httplib::Response& response);
  void LogOut(const httplib::Request& request, httplib::Response& response);
  void SetCookie(httplib::Response& response, const std::string& value, bool ends) const;

  Entry entry_;
  std::string cookie_;
};

}  // namespace trailcast::console
