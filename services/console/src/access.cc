#include "services/console/access.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <chrono>
#include <string_view>

#include "services/base/text.h"
#include "services/console/json.h"
#include "services/console/rights.h"
#include "services/console/src/api/answers.h"
#include "services/http/address.h"

namespace trailcast::console {
namespace {

using httplib::Request;
using httplib::Response;
using users::Role;

constexpr std::string_view kBearer = "Bearer ";

std::string CookieIn(const Request& request, const std::string& name) {
  const std::string header = request.get_header_value("Cookie");
  std::string_view cookies = header;
  while (!cookies.empty()) {
    const std::size_t end = std::min(cookies.find(';'), cookies.size());
    std::string_view cookie = cookies.substr(0, end);
    cookies.remove_prefix(std::min(end + 1, cookies.size()));
    cookie.remove_prefix(std::min(cookie.find_first_not_of(' '), cookie.size()));
    if (cookie.size() > name.size() && cookie.starts_with(name) && cookie[name.size()] == '=') {
      return std::string(cookie.substr(name.size() + 1));
    }
  }
  return "";
}

// Returns nothing if there is none.
std::optional<std::string> TokenIn(const Request& request) {
  const std::string header = request.get_header_value("Authorization");
  if (!header.starts_with(kBearer)) return std::nullopt;
  return header.substr(kBearer.size());
}

void Turn(const users::Turned& turned, Response& response) {
  using Why = users::Turned::Why;
  if (turned.why == Why::kWrong) {
    return Refuse(response, 401, "Wrong user name or password");
  }
  const auto wait = std::chrono::ceil<std::chrono::seconds>(turned.wait).count();
  response.set_header("Retry-After", std::to_string(std::max<std::int64_t>(wait, 1)));
  if (turned.why == Why::kBusy) {
    return Refuse(response, 503, "too many log in at the moment: try again");
  }
  Refuse(response, 429, fmt::format("Wrong user name or password too often: wait {} s", wait));
}

}  // namespace

void Access::At(int port) {
  // Under TLS, the prefix binds the cookie to this host, and to https.
  cookie_ = fmt::format("{}trailcast-{}", encrypted() ? "__Host-" : "", port);
}

void Access::Serve(http::Server& server) {
  server.Post("/api/log-in",
              [this](const Request& request, Response& response) { LogIn(request, response); });
  server.Post("/api/log-out",
              [this](const Request& request, Response& response) { LogOut(request, response); });
  server.Get("/api/me", [this](const Request& request, Response& response) {
    Answer(response, 200, MeBody(WhoIs(request), entry_.guard != nullptr, entry_.only_looks));
  });
}

std::optional<http::Refusal> Access::Judge(const Request& request) const {
  const std::string method = request.method == "HEAD" ? "GET" : request.method;
  const Right right = RightTo(method, request.path);
  if (right.is_known && !right.needs) return std::nullopt;
  const Role needed = right.needs.value_or(Role::kAdminister);
  if (!entry_.only_looks.empty() && needed != Role::kLook) {
    return http::Refusal{403, entry_.only_looks};
  }
  if (!entry_.guard) return std::nullopt;
  const auto who = Known(request);
  if (!who) return http::Refusal{401, "log in first"};
  if (!right.is_known) return http::Refusal{403, "nobody may do this, if it is here at all"};
  if (!users::Includes(who->role, needed)) {
    return http::Refusal{403, fmt::format("{} may not do this: that takes the role '{}'", who->name,
                                          NameOf(needed))};
  }
  // A browser tells which page a POST comes from. Without that, it may be any page.
  if (method != "GET" && !TokenIn(request) && !request.has_header("Origin")) {
    return http::Refusal{403,
                         "who is logged in by a cookie has to send an Origin; programs send a "
                         "token, 'Authorization: Bearer TOKEN'"};
  }
  return std::nullopt;
}

users::Who Access::WhoIs(const Request& request) const {
  if (!entry_.guard) {
    return {.name = "", .role = entry_.only_looks.empty() ? Role::kAdminister : Role::kLook};
  }
  return Known(request).value_or(users::Who{});
}

std::function<bool()> Access::StillIn(const Request& request) const {
  if (!entry_.guard) return [] { return true; };
  if (const auto token = TokenIn(request)) {
    return [this, token] { return entry_.guard->WhoseToken(*token).has_value(); };
  }
  return [this, session = Session(request)] { return entry_.guard->WhoIn(session).has_value(); };
}

std::optional<users::Who> Access::Known(const Request& request) const {
  if (const auto token = TokenIn(request)) return entry_.guard->WhoseToken(*token);
  return entry_.guard->WhoIn(Session(request));
}

std::string Access::Session(const Request& request) const { return CookieIn(request, cookie_); }

std::string Access::AddressOf(const Request& request) const {
  if (!entry_.behind_proxy) return http::AddressKey(request.remote_addr);
  // The proxy has seen the last one. A stranger may have written those before it.
  const std::size_t headers = request.get_header_value_count("X-Forwarded-For");
  const std::string header =
      request.get_header_value("X-Forwarded-For", headers == 0 ? 0 : headers - 1);
  const std::size_t comma = header.rfind(',');
  const std::string last = comma == std::string::npos ? header : header.substr(comma + 1);
  const std::size_t from = last.find_first_not_of(' ');
  return http::AddressKey(from == std::string::npos ? "" : last.substr(from));
}

void Access::LogIn(const Request& request, Response& response) {
  if (!entry_.guard) return Refuse(response, 404, "there are no users here: nobody has to log in");
  const auto body = ReadLogIn(request.body);
  if (!body) return Refuse(response, 400, body.error().message);
  const std::string address = PlainText(AddressOf(request), 64);
  const auto in = entry_.guard->LogIn(body->user, body->password, address);
  if (const auto* turned = std::get_if<users::Turned>(&in)) {
    // The name is not logged, because some people type their password there.
    spdlog::warn("console: a log-in from {} was refused", address.empty() ? "?" : address);
    return Turn(*turned, response);
  }
  spdlog::info("console: {} logs in from {}", body->user, address.empty() ? "?" : address);
  const auto& session = std::get<std::string>(in);
  entry_.guard->LogOut(Session(request));  // this browser's earlier session, if it had one
  SetCookie(response, session, false);
  const auto who = entry_.guard->WhoIn(session).value_or(users::Who{});
  Answer(response, 200, MeBody(who, true, entry_.only_looks));
}

void Access::LogOut(const Request& request, Response& response) {
  if (entry_.guard) entry_.guard->LogOut(Session(request));
  SetCookie(response, "", true);
  Answer(response, 200, "{}");
}

void Access::SetCookie(Response& response, const std::string& value, bool ends) const {
  response.set_header("Set-Cookie",
                      fmt::format("{}={}; Path=/; HttpOnly; SameSite=Strict{}{}", cookie_, value,
                                  encrypted() ? "; Secure" : "", ends ? "; Max-Age=0" : ""));
}

}  // namespace trailcast::console
