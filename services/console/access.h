#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "services/http/server.h"
#include "services/users/guard.h"

namespace trailcast::console {

// This is how the console is reached, and by whom.
struct Entry {
  std::shared_ptr<users::Guard> guard{};  // if null, everyone who reaches it may do everything
  std::optional<http::Tls> tls{};
  bool behind_proxy = false;  // the proxy speaks TLS, and says where its clients are
  std::string only_looks{};   // why no user may give orders; empty if some may
};

// This finds who asks, and whether they may: by a cookie's session for people, and by a token in a
// header for programs. Its methods may be called from any thread.
class Access {
 public:
  explicit Access(Entry entry) : entry_(std::move(entry)) {}

  // Sets the port that the console listens on, because browsers share cookies between a host's
  // ports.
  void At(int port);
  // Serves POST /api/log-in and /api/log-out, and GET /api/me.
  void Serve(http::Server& server);

  // Returns why a request is refused: 401 if the user is not logged in, and 403 if the role is not
  // enough, or another page may have sent the request.
  [[nodiscard]] std::optional<http::Refusal> Judge(const httplib::Request& request) const;
  // Returns the user of a request that was accepted.
  [[nodiscard]] users::Who WhoIs(const httplib::Request& request) const;
  // Returns a function that tells whether the request's user is still accepted, for answers that
  // take long.
  [[nodiscard]] std::function<bool()> StillIn(const httplib::Request& request) const;
  // Returns the users' guard, or null if nobody has to log in.
  [[nodiscard]] const users::Guard* guard() const { return entry_.guard.get(); }
  // Returns whether strangers reach the console, each from an address of their own.
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
