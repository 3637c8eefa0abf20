#include "services/console/json.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <functional>
#include <limits>
#include <set>

#include "services/base/number.h"
#include "services/base/text.h"
#include "services/console/src/values.h"
#include "services/exchange/bounds.h"
#include "services/mission/orders.h"
#include "services/route/query_words.h"

namespace trailcast::console {
namespace {

constexpr std::uint32_t kLongestValid_s = 365U * 86400U;
constexpr std::uint32_t kRoutesAPage = 50;
constexpr std::uint32_t kMostRoutesAPage = 200;
constexpr double kWithin_m = 50.0;

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

// Empty where it is absent.
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

Result<double> NumberIn(const Json& json, const char* field) {
  if (json.contains(field) && json[field].is_number()) return json[field].get<double>();
  return Fail(ErrorCode::kInvalidArgument, "'{}' is to be a number", field);
}

// How a parameter that was given is read into a query.
template <typename Query>
using Readers = std::map<std::string, std::function<Result<void>(const std::string&, Query&)>>;

template <typename Query, typename Number>
auto NumberInto(Number Query::*field) {
  return [field](const std::string& text, Query& query) -> Result<void> {
    if (ReadNumber(text, query.*field)) return {};
    return Fail(ErrorCode::kInvalidArgument, "is no number");
  };
}

template <typename Query>
auto TextInto(std::string Query::*field) {
  return [field](const std::string& text, Query& query) -> Result<void> {
    query.*field = text;
    return {};
  };
}

template <typename Query>
auto NameInto(std::string Query::*field) {
  return [field](const std::string& text, Query& query) -> Result<void> {
    if (!IsValidName(text)) {
      return Fail(ErrorCode::kInvalidArgument,
                  "is to be a name of 1 to 64 letters, digits, '_', '.', '-'");
    }
    query.*field = text;
    return {};
  };
}

template <typename Query>
auto LimitInto(std::uint32_t Query::*field, std::uint32_t most) {
  return [field, most](const std::string& text, Query& query) -> Result<void> {
    const auto limit = ParseNumber<std::uint32_t>(text);
    if (!limit || *limit < 1 || *limit > most) {
      return Fail(ErrorCode::kInvalidArgument, "is to be 1 to {}", most);
    }
    query.*field = *limit;
    return {};
  };
}

// Those of `several` may be given more than once.
template <typename Query>
Result<void> ReadParameters(const Parameters& parameters, const Readers<Query>& readers,
                            const std::string& several, Query& query) {
  for (const auto& [name, text] : parameters) {
    if (text.empty()) continue;  // as a form sends what nobody filled in
    const auto known = readers.find(name);
    if (known == readers.end()) {
      return Fail(ErrorCode::kInvalidArgument, "there is no parameter '{}'", PlainText(name, 64));
    }
    if (name != several && parameters.count(name) > 1) {
      return Fail(ErrorCode::kInvalidArgument, "'{}' is given more than once", name);
    }
    if (auto read = known->second(text, query); !read) {
      return Fail(ErrorCode::kInvalidArgument, "'{}': {}", name, read.error().message);
    }
  }
  return {};
}

template <route::Place::Frame kFrame>
Result<void> ReadNear(const std::string& text, route::RouteQuery& query) {
  const auto place = route::ReadPlace(kFrame, text);
  if (!place) return tl::unexpected(place.error());
  query.near = {*place, kWithin_m};
  return {};
}

template <typename Value>
Result<Value> ReadWord(const std::map<std::string, Value>& words, const std::string& text) {
  const auto word = words.find(text);
  if (word != words.end()) return word->second;
  std::string all;
  for (const auto& [name, value] : words) all += (all.empty() ? "" : ", ") + name;
  return Fail(ErrorCode::kInvalidArgument, "is to be one of {}", all);
}

Result<void> ReadTag(const std::string& text, route::RouteQuery& query) {
  query.tags.push_back(text);
  std::sort(query.tags.begin(), query.tags.end());
  query.tags.erase(std::unique(query.tags.begin(), query.tags.end()), query.tags.end());
  return {};
}

Result<void> ReadState(const std::string& text, route::RouteQuery& query) {
  const auto word = ReadWord(route::StateWords(), text);
  if (!word) return tl::unexpected(word.error());
  query.state = word->state;
  query.standing = word->standing;
  return {};
}

Result<void> ReadSort(const std::string& text, route::RouteQuery& query) {
  const auto word = ReadWord(route::OrderWords(), text);
  if (!word) return tl::unexpected(word.error());
  query.order = *word;
  return {};
}

// With how near that is.
struct PagedQuery : route::RouteQuery {
  double within_m = kWithin_m;
};

const Readers<PagedQuery>& RouteParameters() {
  using Query = PagedQuery;
  static const Readers<Query> kAll{
      {"name", TextInto<Query>(&Query::name)},
      {"prefix", TextInto<Query>(&Query::name_prefix)},
      {"tag", ReadTag},
      {"scout", TextInto<Query>(&Query::scout)},
      {"camera", TextInto<Query>(&Query::camera_prefix)},
      {"min_length_m", NumberInto<Query, double>(&Query::min_length_m)},
      {"max_length_m", NumberInto<Query, double>(&Query::max_length_m)},
      {"taught_from_unix_ms", NumberInto<Query, std::int64_t>(&Query::taught_from_unix_ms)},
      {"taught_until_unix_ms", NumberInto<Query, std::int64_t>(&Query::taught_until_unix_ms)},
      {"state", ReadState},
      {"near_site", ReadNear<route::Place::Frame::kSite>},
      {"near_gps", ReadNear<route::Place::Frame::kWgs84>},
      {"within_m", NumberInto<Query, double>(&Query::within_m)},
      {"sort", ReadSort},
      {"limit", LimitInto<Query>(&Query::page_size, kMostRoutesAPage)},
      {"cursor", TextInto<Query>(&Query::cursor)}};
  return kAll;
}

Readers<mission::Query> RecordParameters() {
  using mission::Query;
  return {{"robot", NameInto<Query>(&Query::agent)},
          {"route", NameInto<Query>(&Query::route)},
          {"by", NameInto<Query>(&Query::client)},
          {"from_unix_ms", NumberInto<Query, std::int64_t>(&Query::from_unix_ms)},
          {"until_unix_ms", NumberInto<Query, std::int64_t>(&Query::until_unix_ms)},
          {"limit", LimitInto<Query>(&Query::page_size, exchange::kMaxMissionsPerReply)},
          {"before", NumberInto<Query, std::uint64_t>(&Query::before)}};
}

Result<void> ReadMissionState(const std::string& text, mission::Query& query) {
  std::string all;
  for (std::uint8_t i = 0; i < mission::kStates; ++i) {
    const std::string word = mission::ToString(static_cast<mission::State>(i));
    if (text == word) {
      query.states |= 1U << i;
      return {};
    }
    all += (all.empty() ? "" : ", ") + word;
  }
  return Fail(ErrorCode::kInvalidArgument, "is to be one of {}", all);
}

const std::map<std::string, route::EditAction>& EditWords() {
  using route::EditAction;
  static const std::map<std::string, EditAction> kWords{
      {"activate", EditAction::kActivate}, {"rollback", EditAction::kRollBack},
      {"rename", EditAction::kRename},     {"tag", EditAction::kTag},
      {"untag", EditAction::kUntag},       {"describe", EditAction::kDescribe},
      {"retire", EditAction::kRetire}};
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

}  // namespace

Result<std::string> ReadReason(const std::string& body) {
  if (body.empty()) return std::string();
  return ReadObject(body, {"reason"}).and_then([](const Json& json) {
    return LineIn(json, "reason");
  });
}

Result<SendBody> ReadSend(const std::string& body) {
  const auto json = ReadObject(body, {"orders", "id", "valid_s", "goes_on"});
  if (!json) return tl::unexpected(json.error());
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
  SendBody send{.orders = *std::move(orders), .id = *std::move(id)};
  if (json->contains("valid_s")) {
    const Json& valid_s = (*json)["valid_s"];
    if (!valid_s.is_number_unsigned() || valid_s.get<std::uint64_t>() > kLongestValid_s) {
      return Fail(ErrorCode::kInvalidArgument, "'valid_s' is to be whole seconds, 0 to {}",
                  kLongestValid_s);
    }
    send.valid_s = valid_s.get<std::uint32_t>();
  }
  if (json->contains("goes_on")) {
    if (!(*json)["goes_on"].is_boolean()) {
      return Fail(ErrorCode::kInvalidArgument, "'goes_on' is to be true or false");
    }
    send.goes_on = (*json)["goes_on"].get<bool>();
  }
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

Result<route::RouteQuery> ReadRouteQuery(const Parameters& parameters) {
  PagedQuery query;
  query.page_size = kRoutesAPage;
  if (auto read = ReadParameters(parameters, RouteParameters(), "tag", query); !read) {
    return tl::unexpected(read.error());
  }
  if (query.near) query.near->radius_m = query.within_m;
  if (auto possible = exchange::CheckQuery(query); !possible) {
    return tl::unexpected(possible.error());
  }
  return query;
}

Result<mission::Query> ReadMissionQuery(const Parameters& parameters) {
  static const Readers<mission::Query> kAll = [] {
    Readers<mission::Query> readers = RecordParameters();
    readers.emplace("mission", NameInto<mission::Query>(&mission::Query::id));
    readers.emplace("state", ReadMissionState);
    return readers;
  }();
  mission::Query query;
  if (auto read = ReadParameters(parameters, kAll, "state", query); !read) {
    return tl::unexpected(read.error());
  }
  return query;
}

Result<mission::Query> ReadCommandQuery(const Parameters& parameters) {
  static const Readers<mission::Query> kAll = RecordParameters();
  mission::Query query;
  if (auto read = ReadParameters(parameters, kAll, "", query); !read) {
    return tl::unexpected(read.error());
  }
  return query;
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

std::string MeBody(const users::Who& who, bool asks, const std::string& only_looks) {
  const bool only = !only_looks.empty();
  return Text({{"user", who.name.empty() ? Json(nullptr) : Json(who.name)},
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
  std::uint64_t number = 0;
  const char* const end = teaching->data() + teaching->size();
  const auto [stop, error] = std::from_chars(teaching->data(), end, number, 16);
  if (error != std::errc{} || stop != end) {
    return Fail(ErrorCode::kInvalidArgument, "'teaching' is to be a hexadecimal number");
  }
  return route::RouteKey{RouteId(*route), TeachingId(number)};
}

std::string ErrorBody(const std::string& why) { return Text({{"error", why}}); }

}  // namespace trailcast::console
