#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "services/base/result.h"
#include "services/route/route_query.h"
#include "services/users/guard.h"

namespace trailcast::console {

// Requests, as openapi.yaml has them. What is read may be anything: kInvalidArgument says what was
// expected.

// {"reason": ".."}, or nothing at all.
[[nodiscard]] Result<std::string> ReadReason(const std::string& body);

struct SendBody {
  std::string orders;
  std::string id;  // empty: to be drawn
  std::uint32_t valid_s = 600;
  bool goes_on = false;
};
[[nodiscard]] Result<SendBody> ReadSend(const std::string& body);

// What comes behind the question mark of an address, decoded.
using Parameters = std::multimap<std::string, std::string>;
// Of GET /api/routes.
[[nodiscard]] Result<route::RouteQuery> ReadRouteQuery(const Parameters& parameters);

struct LogInBody {
  std::string user;
  std::string password;
};
[[nodiscard]] Result<LogInBody> ReadLogIn(const std::string& body);

// `asks`: whether one has to log in.
[[nodiscard]] std::string MeBody(const users::Who& who, bool asks, const std::string& only_looks);
[[nodiscard]] std::string ErrorBody(const std::string& why);

}  // namespace trailcast::console
