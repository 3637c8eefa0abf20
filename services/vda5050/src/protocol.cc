#include "services/vda5050/protocol.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <iterator>

#include "services/base/text.h"
#include "services/program/json.h"

namespace trailcast::vda5050 {
namespace {

using program::Json;

constexpr std::size_t kMostTextBytes = 512;
constexpr std::size_t kMostTopicWordBytes = 64;
constexpr double kStateEvery_s = 30.0;
constexpr double kLeastInterval_s = 0.2;

const char* VersionText(Version version) { return version == Version::k3_0 ? "3.0.0" : "2.1.0"; }

// "2017-04-15T11:40:03.123Z"
std::string Timestamp(std::int64_t unix_ms) {
  using std::chrono::days;
  using std::chrono::milliseconds;
  const std::chrono::sys_time<milliseconds> time{milliseconds(unix_ms)};
  const auto day = std::chrono::floor<days>(time);
  const std::chrono::year_month_day date{day};
  const std::chrono::hh_mm_ss clock{time - day};
  return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}.{:03}Z", static_cast<int>(date.year()),
                     static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()),
                     clock.hours().count(), clock.minutes().count(), clock.seconds().count(),
                     clock.subseconds().count());
}

const char* LevelText(Level level, Version version) {
  const bool is_new = version == Version::k3_0;
  switch (level) {
    case Level::kWarning:
      return "WARNING";
    case Level::kUrgent:
      return is_new ? "URGENT" : "WARNING";
    case Level::kCritical:
      return is_new ? "CRITICAL" : "FATAL";
    case Level::kFatal:
      break;
  }
  return "FATAL";
}

const char* ToText(Connection connection, Version version) {
  switch (connection) {
    case Connection::kOnline:
      return "ONLINE";
    case Connection::kOffline:
      return "OFFLINE";
    case Connection::kBroken:
      break;
  }
  return version == Version::k3_0 ? "CONNECTION_BROKEN" : "CONNECTIONBROKEN";
}

struct InstantAction {
  const char* type;
  const char* description;
  bool also_in_2_1;
};
constexpr InstantAction kInstantActions[] = {
    {"cancelOrder", "ends the order: the robot stands where it is", true},
    {"startPause", "has the robot stand where it is, and keep its order", true},
    {"stopPause", "has the robot go on after a pause", true},
    {"stateRequest", "has the state sent", true},
    {"factsheetRequest", "has this factsheet sent", true},
    {"clearInstantActions", "has finished and failed instant actions told no more", false}};

Json ActionsJson(Version version) {
  const bool is_new = version == Version::k3_0;
  Json actions = Json::array();
  for (const InstantAction& each : kInstantActions) {
    if (!is_new && !each.also_in_2_1) continue;
    Json action{{"actionType", each.type},
                {"actionDescription", each.description},
                {"actionScopes", {"INSTANT"}}};
    if (each.type == std::string_view("cancelOrder") && is_new) {
      action["actionParameters"] =
          Json::array({{{"key", "orderId"}, {"valueDataType", "STRING"}, {"isOptional", true}}});
    }
    if (is_new) {
      action["blockingTypes"] = {"NONE"};
      action["pauseAllowed"] = false;
      action["cancelAllowed"] = false;
    }
    actions.push_back(std::move(action));
  }
  return actions;
}

Json LimitsJson(Version version) {
  const bool is_new = version == Version::k3_0;
  Json strings;
  strings[is_new ? "maximumMessageLength" : "msgLen"] = kMostBytes;
  strings[is_new ? "maximumTopicSerialLength" : "topicSerialLen"] = kMostTopicWordBytes;
  strings[is_new ? "maximumTopicElementLength" : "topicElemLen"] = kMostTopicWordBytes;
  strings[is_new ? "maximumIdLength" : "idLen"] = kMostIdBytes;
  Json timing;
  timing[is_new ? "minimumOrderInterval" : "minOrderInterval"] = kLeastInterval_s;
  timing[is_new ? "minimumStateInterval" : "minStateInterval"] = kLeastInterval_s;
  timing["defaultStateInterval"] = kStateEvery_s;
  Json limits;
  limits[is_new ? "maximumStringLengths" : "maxStringLens"] = std::move(strings);
  limits[is_new ? "maximumArrayLengths" : "maxArrayLens"] = {{"order.nodes", kMostNodes},
                                                             {"order.edges", kMostNodes - 1},
                                                             {"instantActions", kMostActions}};
  limits["timing"] = std::move(timing);
  return limits;
}

}  // namespace

bool IsTopicWord(std::string_view text) {
  return !text.empty() && text.size() <= kMostTopicWordBytes &&
         std::all_of(text.begin(), text.end(), [](char c) {
           return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                  c == '_' || c == '.' || c == ':' || c == '-';
         });
}

std::string TopicOf(const Identity& identity, std::string_view topic) {
  return fmt::format("{}/{}/{}/{}", identity.version == Version::k3_0 ? "vda5050/v3" : "uagv/v2",
                     identity.manufacturer, identity.serial, topic);
}

Json Header(const Identity& identity, std::uint32_t header_id, std::int64_t unix_ms) {
  return {{"headerId", header_id},
          {"timestamp", Timestamp(unix_ms)},
          {"version", VersionText(identity.version)},
          {"manufacturer", identity.manufacturer},
          {"serialNumber", identity.serial}};
}

Json FaultJson(const Fault& fault, Version version) {
  Json references = Json::array();
  for (const auto& [key, value] : fault.references) {
    references.push_back({{"referenceKey", PlainText(key, kMostTextBytes)},
                          {"referenceValue", PlainText(value, kMostTextBytes)}});
  }
  Json json{{"errorType", fault.type},
            {"errorReferences", std::move(references)},
            {"errorDescription", PlainText(fault.description, kMostTextBytes)},
            {"errorLevel", LevelText(fault.level, version)}};
  if (!fault.hint.empty()) json["errorHint"] = PlainText(fault.hint, kMostTextBytes);
  return json;
}

std::string ConnectionText(const Identity& identity, Connection connection, std::uint32_t header_id,
                           std::int64_t unix_ms) {
  Json json = Header(identity, header_id, unix_ms);
  json["connectionState"] = ToText(connection, identity.version);
  return program::OneLine(json);
}

std::string FactsheetText(const Identity& identity, const Body& body, std::uint32_t header_id,
                          std::int64_t unix_ms) {
  const bool is_new = identity.version == Version::k3_0;
  Json json = Header(identity, header_id, unix_ms);
  json["typeSpecification"] = {
      {"seriesName", body.series},
      {"seriesDescription", "follows taught routes by its camera, and knows no positions on a map"},
      {is_new ? "mobileRobotKinematics" : "agvKinematic", is_new ? "DIFFERENTIAL" : "DIFF"},
      {is_new ? "mobileRobotClass" : "agvClass", "CARRIER"},
      {is_new ? "maximumLoadMass" : "maxLoadMass", 0.0},
      {"localizationTypes", {"NATURAL"}},
      {"navigationTypes", {"VIRTUAL_LINE_GUIDED"}}};
  json["physicalParameters"] = {
      {is_new ? "minimumSpeed" : "speedMin", 0.0},
      {is_new ? "maximumSpeed" : "speedMax", body.most_speed_mps},
      {is_new ? "maximumAcceleration" : "accelerationMax", body.most_acceleration},
      {is_new ? "maximumDeceleration" : "decelerationMax", body.most_acceleration},
      {is_new ? "minimumHeight" : "heightMin", body.height_m},
      {is_new ? "maximumHeight" : "heightMax", body.height_m},
      {"width", body.width_m},
      {"length", body.length_m}};
  json["protocolLimits"] = LimitsJson(identity.version);
  json["protocolFeatures"] = {
      {"optionalParameters", Json::array()},
      {is_new ? "mobileRobotActions" : "agvActions", ActionsJson(identity.version)}};
  json[is_new ? "mobileRobotGeometry" : "agvGeometry"] = Json::object();
  json["loadSpecification"] = Json::object();
  return program::OneLine(json);
}

}  // namespace trailcast::vda5050
