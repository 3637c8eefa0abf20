#include "services/console/json.h"

#include <fmt/format.h>

#include <limits>
#include <set>

#include "services/base/process_name.h"
#include "services/base/text.h"
#include "services/console/src/values.h"
#include "services/exchange/bounds.h"
#include "services/mission/orders.h"

namespace trailcast::console {
namespace {

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

Json WordValue(const fleet::RobotsWord& word) {
  return {{"robot", word.robot},
          {"answered", word.answered},
          {"obeys", word.answered && !word.refused},
          {"detail", word.detail}};
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

Json RecordValue(const mission::Record& record) {
  const mission::Mission& mission = record.mission;
  return {{"mission", mission.id},
          {"robot", mission.agent.value()},
          {"orders", mission.orders},
          {"sent_by", WithoutProcess(mission.client.value())},
          {"state", mission::ToString(record.last.state)},
          {"task", record.last.task},
          {"detail", record.last.detail},
          {"sent_unix_ms", record.sent_unix_ms},
          {"changed_unix_ms", record.changed_unix_ms}};
}

std::string ErrorBody(const std::string& why) { return Text({{"error", why}}); }

std::string WordBody(const fleet::RobotsWord& word) { return Text(WordValue(word)); }

std::string WordsBody(const std::vector<fleet::RobotsWord>& words) {
  Json robots = Json::array();
  for (const fleet::RobotsWord& word : words) robots.push_back(WordValue(word));
  return Text({{"robots", std::move(robots)}});
}

std::string ReportBody(const mission::Report& report) {
  return Text({{"mission", report.mission},
               {"robot", report.agent.value()},
               {"state", mission::ToString(report.state)},
               {"task", report.task},
               {"detail", report.detail}});
}

std::string MissionsBody(const std::vector<mission::Record>& missions) {
  Json list = Json::array();
  for (const mission::Record& record : missions) list.push_back(RecordValue(record));
  return Text({{"missions", std::move(list)}});
}

}  // namespace trailcast::console
