#include "services/console/json.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <set>

#include "services/base/text.h"
#include "services/console/parameters.h"
#include "services/console/src/api/words.h"
#include "services/exchange/bounds.h"
#include "services/mission/address.h"
#include "services/mission/orders.h"
#include "services/network/words.h"
#include "services/program/json.h"

namespace trailcast::console {
namespace {

using program::Json;
using program::OneLine;

constexpr std::uint32_t kLongestValid_s = 365U * 86400U;

Result<Json> ReadObject(const std::string& body, const std::set<std::string>& fields) {
  Json json = Json::parse(body, nullptr, /*allow_exceptions=*/false);
  if (!json.is_object()) {
    return Fail(ErrorCode::kInvalidArgument,
                "the body is no JSON object, as {{\"reason\": \"..\"}}");
  }
  for (const auto& [name, value] : json.items()) {
    if (!fields.contains(name)) {
      return Fail(ErrorCode::kInvalidArgument, "there is no field '{}'", PlainText(name, 64));
    }
  }
  return json;
}

// Returns an empty text if the field is absent.
Result<std::string> LineIn(const Json& json, const char* field) {
  if (!json.contains(field)) return std::string();
  const Json& value = json[field];
  if (!value.is_string() ||
      !IsPlainText(value.get_ref<const std::string&>(), exchange::kMaxLineBytes)) {
    return Fail(ErrorCode::kInvalidArgument, "'{}' is to be a text of one line, at most {} bytes",
                field, exchange::kMaxLineBytes);
  }
  return value.get<std::string>();
}

Result<UserChangeBody> RoleAndPasswordIn(const Json& json) {
  UserChangeBody change;
  if (json.contains("role")) {
    const Json& role = json["role"];
    if (role.is_string()) change.role = users::FindRole(role.get_ref<const std::string&>());
    if (!change.role) {
      return Fail(ErrorCode::kInvalidArgument, "'role' is to be look, operate or administer");
    }
  }
  if (json.contains("password")) {
    if (!json["password"].is_string()) {
      return Fail(ErrorCode::kInvalidArgument, "'password' is to be a text");
    }
    change.password = json["password"].get<std::string>();
  }
  return change;
}

Result<double> NumberIn(const Json& json, const char* field) {
  if (json.contains(field) && json[field].is_number()) return json[field].get<double>();
  return Fail(ErrorCode::kInvalidArgument, "'{}' is to be a number", field);
}

const std::map<std::string, route::EditAction>& EditWords() {
  using route::EditAction;
  static const std::map<std::string, EditAction> kWords{
      {"activate", EditAction::kActivate}, {"rollback", EditAction::kRollBack},
      {"rename", EditAction::kRename},     {"tag", EditAction::kTag},
      {"untag", EditAction::kUntag},       {"describe", EditAction::kDescribe},
      {"retire", EditAction::kRetire},     {"delete", EditAction::kDelete}};
  return kWords;
}

Result<std::vector<std::string>> TagsIn(const Json& json) {
  std::vector<std::string> tags;
  if (!json.contains("tags")) return tags;
  const Json& list = json["tags"];
  if (!list.is_array() || list.size() > route::kMaxTags) {
    return Fail(ErrorCode::kInvalidArgument, "'tags' is to be a list of at most {} words",
                route::kMaxTags);
  }
  for (const Json& tag : list) {
    if (!tag.is_string()) {
      return Fail(ErrorCode::kInvalidArgument, "'tags' is to be a list of words");
    }
    tags.push_back(tag.get<std::string>());
  }
  std::sort(tags.begin(), tags.end());
  tags.erase(std::unique(tags.begin(), tags.end()), tags.end());
  return tags;
}

Result<PhotosBody> PhotosIn(const Json& json) {
  PhotosBody photos;
  if (json.contains("photo_every_m")) {
    const auto every_m = NumberIn(json, "photo_every_m");
    if (!every_m) return tl::unexpected(every_m.error());
    if (*every_m <= 0.0) {
      return Fail(ErrorCode::kInvalidArgument, "'photo_every_m' is to be metres, 0.2 or more");
    }
    photos.every_m = *every_m;
  }
  if (!json.contains("photo_at")) return photos;
  const Json& places = json["photo_at"];
  const bool are_lines =
      places.is_array() && places.size() <= mission::kMostPhotoPlaces &&
      std::all_of(places.begin(), places.end(), [](const Json& place) {
        return place.is_string() &&
               IsPlainText(place.get_ref<const std::string&>(), exchange::kMaxLineBytes);
      });
  if (!are_lines) {
    return Fail(ErrorCode::kInvalidArgument,
                "'photo_at' is to be a list of at most {} places, each ROUTE@METRES or a name",
                mission::kMostPhotoPlaces);
  }
  for (const Json& place : places) photos.at.push_back(place.get<std::string>());
  return photos;
}

}  // namespace

Result<std::string> ReadReason(const std::string& body) {
  if (body.empty()) return std::string();
  return ReadObject(body, {"reason"}).and_then([](const Json& json) {
    return LineIn(json, "reason");
  });
}

std::string ReasonIfAny(const std::string& body) {
  const Json json = Json::parse(body, nullptr, /*allow_exceptions=*/false);
  const bool has_one = json.is_object() && json.contains("reason") && json["reason"].is_string();
  if (!has_one) return {};
  return PlainText(json["reason"].get_ref<const std::string&>(), exchange::kMaxLineBytes);
}

Result<SendBody> ReadSend(const std::string& body, bool has_to) {
  std::set<std::string> names{"orders",        "id",      "valid_s", "goes_on", "unheard",
                              "photo_every_m", "photo_at"};
  if (has_to) names.insert("to");
  const auto json = ReadObject(body, names);
  if (!json) return tl::unexpected(json.error());
  auto to = LineIn(*json, "to");
  if (!to) return tl::unexpected(to.error());
  if (const auto addressed = mission::ParseAddress(*to); has_to && !addressed) {
    return Fail(ErrorCode::kInvalidArgument, "'to': {}", addressed.error().message);
  }
  auto orders = LineIn(*json, "orders");
  if (!orders) return tl::unexpected(orders.error());
  if (const auto tasks = mission::ParseOrders(*orders); !tasks) {
    return tl::unexpected(tasks.error());
  }
  auto id = LineIn(*json, "id");
  if (!id) return tl::unexpected(id.error());
  if (!id->empty() && !IsValidName(*id)) {
    return Fail(ErrorCode::kInvalidArgument,
                "'id' is to be a name of 1 to 64 letters, digits, '_', '.', '-'");
  }
  SendBody send{.to = *std::move(to), .orders = *std::move(orders), .id = *std::move(id)};
  if (json->contains("valid_s")) {
    const Json& valid_s = (*json)["valid_s"];
    if (!valid_s.is_number_unsigned() || valid_s.get<std::uint64_t>() > kLongestValid_s) {
      return Fail(ErrorCode::kInvalidArgument, "'valid_s' is to be whole seconds, 0 to {}",
                  kLongestValid_s);
    }
    send.valid_s = valid_s.get<std::uint32_t>();
  }
  for (const auto& [name, value] :
       {std::pair{"goes_on", &send.goes_on}, {"unheard", &send.unheard}}) {
    if (!json->contains(name)) continue;
    if (!(*json)[name].is_boolean()) {
      return Fail(ErrorCode::kInvalidArgument, "'{}' is to be true or false", name);
    }
    *value = (*json)[name].get<bool>();
  }
  auto photos = PhotosIn(*json);
  if (!photos) return tl::unexpected(photos.error());
  send.photos = *std::move(photos);
  return send;
}

Result<Driving::Word> ReadDrive(const std::string& body) {
  const auto json = ReadObject(body, {"linear_mps", "turn_radps", "driver", "said_ms"});
  if (!json) return tl::unexpected(json.error());
  const auto linear_mps = NumberIn(*json, "linear_mps");
  if (!linear_mps) return tl::unexpected(linear_mps.error());
  const auto turn_radps = NumberIn(*json, "turn_radps");
  if (!turn_radps) return tl::unexpected(turn_radps.error());
  auto driver = LineIn(*json, "driver");
  if (!driver) return tl::unexpected(driver.error());
  if (!IsValidName(*driver)) {
    return Fail(ErrorCode::kInvalidArgument,
                "'driver' is to be a name of 1 to 64 letters, digits, '_', '.', '-', the same one "
                "for as long as one person drives");
  }
  if (!json->contains("said_ms") || !(*json)["said_ms"].is_number_unsigned()) {
    return Fail(ErrorCode::kInvalidArgument,
                "'said_ms' is to be a whole number: by the driver's clock, from any time on");
  }
  const exchange::DriveCommand command{.agent = AgentId("robot"),
                                       .client = AgentId("console"),
                                       .linear_mps = *linear_mps,
                                       .turn_radps = *turn_radps};
  if (auto possible = exchange::CheckBounds(command); !possible) {
    return tl::unexpected(possible.error());
  }
  return Driving::Word{.linear_mps = *linear_mps,
                       .turn_radps = *turn_radps,
                       .driver = *std::move(driver),
                       .said_ms = (*json)["said_ms"].get<std::uint64_t>()};
}

Result<route::RouteEdit> ReadRouteEdit(const std::string& route, const std::string& body) {
  const auto json = ReadObject(body, {"action", "revision", "text", "tags"});
  if (!json) return tl::unexpected(json.error());
  const auto action = LineIn(*json, "action").and_then([](const std::string& word) {
    return ReadWord(EditWords(), word);
  });
  if (!action) return Wrap(action.error(), "'action'");
  const auto text = LineIn(*json, "text");
  if (!text) return tl::unexpected(text.error());
  const auto tags = TagsIn(*json);
  if (!tags) return tl::unexpected(tags.error());
  route::RouteEdit edit{.action = *action, .route = route, .text = *text, .tags = *tags};
  if (json->contains("revision")) {
    const Json& revision = (*json)["revision"];
    constexpr auto kMost = std::numeric_limits<std::uint32_t>::max();
    if (!revision.is_number_unsigned() || revision.get<std::uint64_t>() > kMost) {
      return Fail(ErrorCode::kInvalidArgument, "'revision' is to be a number, 0 for all");
    }
    edit.revision = revision.get<std::uint32_t>();
  }
  if (edit.action == route::EditAction::kDelete && edit.revision == 0) {
    return Fail(
        ErrorCode::kInvalidArgument,
        "'delete' takes one 'revision': a whole route is deleted by 'trailcast routes delete'");
  }
  const bool of_whole_route =
      edit.action == route::EditAction::kRename || edit.action == route::EditAction::kRollBack;
  if (of_whole_route && edit.revision != 0) {
    return Fail(ErrorCode::kInvalidArgument, "this is about the whole route: leave 'revision' out");
  }
  if (auto possible = exchange::CheckEdit(edit); !possible) {
    return tl::unexpected(possible.error());
  }
  return edit;
}

Result<std::string> ReadNetworkEdit(const std::string& body) {
  return ReadObject(body, {"words"})
      .and_then([](const Json& json) { return LineIn(json, "words"); })
      .and_then([](const std::string& words) -> Result<std::string> {
        if (const auto edit = network::ParseEdit(words); !edit) return tl::unexpected(edit.error());
        return words;
      });
}

Result<ScheduleBody> ReadSchedule(const std::string& body) {
  const auto json = ReadObject(body, {"words", "photo_every_m", "photo_at"});
  if (!json) return tl::unexpected(json.error());
  auto schedule = LineIn(*json, "words").and_then([](const std::string& words) {
    return schedule::ParseSchedule(words);
  });
  if (!schedule) return tl::unexpected(schedule.error());
  auto photos = PhotosIn(*json);
  if (!photos) return tl::unexpected(photos.error());
  return ScheduleBody{.schedule = *std::move(schedule), .photos = *std::move(photos)};
}

Result<LogInBody> ReadLogIn(const std::string& body) {
  const auto json = ReadObject(body, {"user", "password"});
  if (!json) return tl::unexpected(json.error());
  LogInBody log_in;
  for (const auto& [field, text] :
       {std::pair{"user", &log_in.user}, std::pair{"password", &log_in.password}}) {
    if (!json->contains(field) || !(*json)[field].is_string()) {
      return Fail(ErrorCode::kInvalidArgument, "'{}' is to be a text", field);
    }
    *text = (*json)[field].get<std::string>();
  }
  return log_in;
}

Result<NewUserBody> ReadNewUser(const std::string& body) {
  const auto json = ReadObject(body, {"user", "role", "password", "token"});
  if (!json) return tl::unexpected(json.error());
  const auto change = RoleAndPasswordIn(*json);
  if (!change) return tl::unexpected(change.error());
  const auto user = LineIn(*json, "user");
  if (!user || !users::IsUserName(*user)) {
    return Fail(ErrorCode::kInvalidArgument,
                "'user' is to be 1 to {} of letters, digits, '_', '.' and '-'",
                users::kLongestName);
  }
  if (!change->role) {
    return Fail(ErrorCode::kInvalidArgument, "'role' is to be look, operate or administer");
  }
  const bool token = json->contains("token");
  if (token && (*json)["token"] != true) {
    return Fail(ErrorCode::kInvalidArgument, "'token' is to be true, or absent");
  }
  if (token == change->password.has_value()) {
    return Fail(ErrorCode::kInvalidArgument, "either 'password' or 'token' is to be there");
  }
  return NewUserBody{.user = *user, .role = *change->role, .password = change->password};
}

Result<UserChangeBody> ReadUserChange(const std::string& body) {
  return ReadObject(body, {"role", "password"})
      .and_then(RoleAndPasswordIn)
      .and_then([](const UserChangeBody& change) -> Result<UserChangeBody> {
        if (change.role || change.password) return change;
        return Fail(ErrorCode::kInvalidArgument, "'role' or 'password' is to be there");
      });
}

std::string MeBody(const users::Who& who, bool asks, const std::string& only_looks) {
  const bool only = !only_looks.empty();
  return OneLine({{"user", who.name.empty() ? Json(nullptr) : Json(who.name)},
                  {"role", users::NameOf(only ? users::Role::kLook : who.role)},
                  {"logs_in", asks},
                  {"only_looks", only ? Json(only_looks) : Json(nullptr)}});
}

Result<route::RouteKey> ReadFetch(const std::string& body) {
  const auto json = ReadObject(body, {"route", "teaching"});
  if (!json) return tl::unexpected(json.error());
  const auto route = LineIn(*json, "route");
  const auto teaching = LineIn(*json, "teaching");
  if (!route) return tl::unexpected(route.error());
  if (!teaching) return tl::unexpected(teaching.error());
  constexpr std::size_t kIdDigits = 32;
  if (route->size() != kIdDigits || !IsValidName(*route)) {
    return Fail(ErrorCode::kInvalidArgument, "'route' is to be a route's id, of {} digits",
                kIdDigits);
  }
  const auto number = ReadTeaching(*teaching);
  if (!number) return Wrap(number.error(), "'teaching'");
  return route::RouteKey{RouteId(*route), *number};
}

std::string ErrorBody(const std::string& why) { return OneLine({{"error", why}}); }

}  // namespace trailcast::console
