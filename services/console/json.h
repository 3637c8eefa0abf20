#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "services/base/result.h"
#include "services/console/driving.h"
#include "services/route/route_edit.h"
#include "services/schedule/schedule.h"
#include "services/users/guard.h"

namespace trailcast::console {

// These read bodies of requests, as openapi.yaml has them. A body may be anything. Errors are
// kInvalidArgument and say what was expected.

// Reads {"reason": ".."}, or an empty body.
[[nodiscard]] Result<std::string> ReadReason(const std::string& body);
// Reads the same from any body, makes it one line, and returns an empty text if there is none.
[[nodiscard]] std::string ReasonIfAny(const std::string& body);

// The photos that a mission takes on its way.
struct PhotosBody {
  double every_m = 0.0;           // 0 for none
  std::vector<std::string> at{};  // ROUTE@METRES, or names
};

struct SendBody {
  std::string to{};
  std::string orders{};
  std::string id{};  // empty if it is to be drawn
  std::uint32_t valid_s = 600;
  bool goes_on = false;
  bool unheard = false;  // also to a robot that nobody has heard of
  PhotosBody photos{};
};
// The body of a mission for whom the address does not say has `to` (mission/address.h), too.
[[nodiscard]] Result<SendBody> ReadSend(const std::string& body, bool has_to = false);

// Reads how `route`, a name or id, is to be changed.
[[nodiscard]] Result<route::RouteEdit> ReadRouteEdit(const std::string& route,
                                                     const std::string& body);

// Reads {"linear_mps", "turn_radps", "driver", "said_ms"}, all of which are required.
[[nodiscard]] Result<Driving::Word> ReadDrive(const std::string& body);

// Reads {"words": ".."}, a change of the network in a server's words (network/words.h).
[[nodiscard]] Result<std::string> ReadNetworkEdit(const std::string& body);

struct ScheduleBody {
  schedule::Schedule schedule{};
  PhotosBody photos{};
};
// Reads {"words": ".."}, a new schedule (schedule/schedule.h), and the photos of its missions.
[[nodiscard]] Result<ScheduleBody> ReadSchedule(const std::string& body);

struct LogInBody {
  std::string user;
  std::string password;
};
[[nodiscard]] Result<LogInBody> ReadLogIn(const std::string& body);

struct NewUserBody {
  std::string user;
  users::Role role = users::Role::kLook;
  std::optional<std::string> password{};  // empty for a program, which gets a token
};
// Reads {"user", "role"} with either {"password"} or {"token": true}.
[[nodiscard]] Result<NewUserBody> ReadNewUser(const std::string& body);
struct UserChangeBody {
  std::optional<users::Role> role{};
  std::optional<std::string> password{};
};
// Reads {"role"}, {"password"} or both.
[[nodiscard]] Result<UserChangeBody> ReadUserChange(const std::string& body);

// Returns the answer about the user. `asks` tells whether users have to log in.
[[nodiscard]] std::string MeBody(const users::Who& who, bool asks, const std::string& only_looks);
// Reads which revision is to be fetched: {"route": its id, "teaching": "1f"}.
[[nodiscard]] Result<route::RouteKey> ReadFetch(const std::string& body);

[[nodiscard]] std::string ErrorBody(const std::string& why);

}  // namespace trailcast::console
