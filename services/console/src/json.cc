#include "services/console/json.h"

#include <fmt/format.h>

#include <algorithm>
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

// A parameter that was given, and how it is read into the query.
using ReadParameter = Result<void> (*)(const std::string& text, route::RouteQuery& query);

template <typename Number, Number route::RouteQuery::*kField>
Result<void> ReadNumberInto(const std::string& text, route::RouteQuery& query) {
  if (ReadNumber(text, query.*kField)) return {};
  return Fail(ErrorCode::kInvalidArgument, "is no number");
}

template <std::string route::RouteQuery::*kField>
Result<void> ReadTextInto(const std::string& text, route::RouteQuery& query) {
  query.*kField = text;
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

Result<void> ReadLimit(const std::string& text, route::RouteQuery& query) {
  const auto limit = ParseNumber<std::uint32_t>(text);
  if (!limit || *limit < 1 || *limit > kMostRoutesAPage) {
    return Fail(ErrorCode::kInvalidArgument, "is to be 1 to {}", kMostRoutesAPage);
  }
  query.page_size = *limit;
  return {};
}

const std::map<std::string, ReadParameter>& RouteParameters() {
  using route::RouteQuery;
  static const std::map<std::string, ReadParameter> kAll{
      {"name", ReadTextInto<&RouteQuery::name>},
      {"prefix", ReadTextInto<&RouteQuery::name_prefix>},
      {"tag", ReadTag},
      {"scout", ReadTextInto<&RouteQuery::scout>},
      {"camera", ReadTextInto<&RouteQuery::camera_prefix>},
      {"min_length_m", ReadNumberInto<double, &RouteQuery::min_length_m>},
      {"max_length_m", ReadNumberInto<double, &RouteQuery::max_length_m>},
      {"taught_from_unix_ms", ReadNumberInto<std::int64_t, &RouteQuery::taught_from_unix_ms>},
      {"taught_until_unix_ms", ReadNumberInto<std::int64_t, &RouteQuery::taught_until_unix_ms>},
      {"state", ReadState},
      {"near_site", ReadNear<route::Place::Frame::kSite>},
      {"near_gps", ReadNear<route::Place::Frame::kWgs84>},
      {"sort", ReadSort},
      {"limit", ReadLimit},
      {"cursor", ReadTextInto<&RouteQuery::cursor>}};
  return kAll;
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

Result<route::RouteQuery> ReadRouteQuery(const Parameters& parameters) {
  route::RouteQuery query;
  query.page_size = kRoutesAPage;
  double within_m = kWithin_m;
  for (const auto& [name, text] : parameters) {
    if (text.empty()) continue;  // as a form sends what nobody filled in
    if (name == "within_m") {
      if (!ReadNumber(text, within_m)) {
        return Fail(ErrorCode::kInvalidArgument, "'within_m' is no number");
      }
      continue;
    }
    const auto known = RouteParameters().find(name);
    if (known == RouteParameters().end()) {
      return Fail(ErrorCode::kInvalidArgument, "there is no parameter '{}'", PlainText(name, 64));
    }
    if (name != "tag" && parameters.count(name) > 1) {
      return Fail(ErrorCode::kInvalidArgument, "'{}' is given more than once", name);
    }
    if (auto read = known->second(text, query); !read) {
      return Fail(ErrorCode::kInvalidArgument, "'{}': {}", name, read.error().message);
    }
  }
  if (query.near) query.near->radius_m = within_m;
  if (auto possible = exchange::CheckQuery(query); !possible) {
    return tl::unexpected(possible.error());
  }
  return query;
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

std::string ErrorBody(const std::string& why) { return Text({{"error", why}}); }

}  // namespace trailcast::console
