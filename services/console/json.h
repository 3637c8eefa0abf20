#pragma once

#include <cstdint>
#include <string>

#include "services/base/result.h"
#include "services/console/driving.h"
#include "services/route/route_edit.h"
#include "services/users/guard.h"

namespace trailcast::console {

// Bodies of requests, as openapi.yaml has them. What is read may be anything: kInvalidArgument says
// what was expected.

// {"reason": ".."}, or nothing at all.
[[nodiscard]] Result<std::string> ReadReason(const std::string& body);
// The same of a body that may be anything: made one line, and empty where there is none.
[[nodiscard]] std::string ReasonIfAny(const std::string& body);

struct SendBody {
  std::string orders;
  std::string id;  // empty: to be drawn
  std::uint32_t valid_s = 600;
  bool goes_on = false;
  bool unheard = false;  // also a robot that nobody has heard of
};
[[nodiscard]] Result<SendBody> ReadSend(const std::string& body);

// How `route`, by its name or id, is to be changed.
[[nodiscard]] Result<route::RouteEdit> ReadRouteEdit(const std::string& route,
                                                     const std::string& body);

// {"linear_mps", "turn_radps", "driver", "said_ms"}: all of it.
[[nodiscard]] Result<Driving::Word> ReadDrive(const std::string& body);

// {"words": ".."}: what is changed of the network, in a server's words (network/words.h).
[[nodiscard]] Result<std::string> ReadNetworkEdit(const std::string& body);

struct LogInBody {
  std::string user;
  std::string password;
};
[[nodiscard]] Result<LogInBody> ReadLogIn(const std::string& body);

// `asks`: whether one has to log in.
[[nodiscard]] std::string MeBody(const users::Who& who, bool asks, const std::string& only_looks);
// Which revision is to be fetched: {"route": its id, "teaching": "1f"}.
[[nodiscard]] Result<route::RouteKey> ReadFetch(const std::string& body);

[[nodiscard]] std::string ErrorBody(const std::string& why);

}  // namespace trailcast::console
