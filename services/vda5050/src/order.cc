#include "services/vda5050/order.h"

#include <fmt/format.h>

#include <array>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "services/base/text.h"

namespace trailcast::vda5050 {
namespace {

// Members are sorted, so that two messages that say the same have the same text.
using Parsed = nlohmann::json;
using Refused = tl::unexpected<Fault>;

template <typename... Args>
Fault Malformed(fmt::format_string<Args...> format, Args&&... args) {
  return {.type = "VALIDATION_FAILURE",
          .description = fmt::format(format, std::forward<Args>(args)...)};
}

// These fields ask for what a robot that follows routes does not do. A null asks for nothing.
constexpr std::array kUnsupportedOfOrder{"zoneSetId"};
constexpr std::array kUnsupportedOfEdge{"maximumSpeed",
                                        "maximumMobileRobotHeight",
                                        "minimumLoadHandlingDeviceHeight",
                                        "orientation",
                                        "orientationType",
                                        "direction",
                                        "reachOrientationBeforeEntering",
                                        "maxRotationSpeed",
                                        "trajectory",
                                        "corridor",
                                        "maxSpeed",
                                        "maxHeight",
                                        "minHeight",
                                        "rotationAllowed"};

const Parsed* Member(const Parsed& object, const char* name) {
  const auto found = object.find(name);
  return found == object.end() ? nullptr : &*found;
}

std::optional<std::string> Text(const Parsed& object, const char* name, std::size_t least = 1) {
  const Parsed* member = Member(object, name);
  if (member == nullptr || !member->is_string()) return std::nullopt;
  const auto& text = member->get_ref<const std::string&>();
  if (text.size() < least || !IsPlainText(text, kMostIdBytes)) return std::nullopt;
  return text;
}

std::optional<std::uint32_t> Count(const Parsed& object, const char* name) {
  const Parsed* member = Member(object, name);
  if (member == nullptr || !member->is_number_unsigned()) return std::nullopt;
  const auto value = member->get<std::uint64_t>();
  if (value > std::numeric_limits<std::uint32_t>::max()) return std::nullopt;
  return static_cast<std::uint32_t>(value);
}

// The message as an object with a header of this robot's.
tl::expected<Parsed, Fault> ParseMessage(const Identity& identity, std::string_view topic,
                                         std::string_view payload) {
  if (payload.size() > kMostBytes) return Refused(TooLong(topic, payload.size()));
  Parsed message = Parsed::parse(payload, nullptr, false);
  if (message.is_discarded()) return Refused(Malformed("the message is no JSON"));
  if (!message.is_object()) return Refused(Malformed("the message is no JSON object"));
  if (!Count(message, "headerId")) {
    return Refused(Malformed("headerId is missing, or no whole number from 0"));
  }
  if (!Text(message, "timestamp")) return Refused(Malformed("timestamp is missing, or no text"));
  const auto version = Text(message, "version");
  const std::string_view major = identity.version == Version::k3_0 ? "3." : "2.";
  if (!version || !version->starts_with(major)) {
    return Refused(Malformed("version is '{}': {}0.0 or another of that number is expected",
                             version.value_or(""), major));
  }
  for (const auto& [name, own] : {std::pair("manufacturer", &identity.manufacturer),
                                  std::pair("serialNumber", &identity.serial)}) {
    const auto told = Text(message, name);
    if (told != *own) {
      return Refused(Malformed("{} is '{}', and this is '{}'", name, told.value_or(""), *own));
    }
  }
  return message;
}

std::optional<Fault> TakeActions(const Parsed& step, const std::string& of) {
  const Parsed* actions = Member(step, "actions");
  if (actions == nullptr || !actions->is_array()) {
    return Malformed("{} has no list of actions", of);
  }
  if (actions->empty()) return std::nullopt;
  const Parsed& first = actions->front();
  Fault fault{.type = "INVALID_ORDER_ACTION",
              .description = fmt::format("{} has actions: a robot that follows routes has none to "
                                         "do on its way",
                                         of)};
  if (first.is_object()) {
    fault.references = {{"actionId", Text(first, "actionId").value_or("")},
                        {"actionType", Text(first, "actionType").value_or("")}};
  }
  return fault;
}

// A node's position is refused, since robots that know none cannot see to it.
std::optional<Fault> Unsupported(const Parsed& node) {
  const Parsed* position = Member(node, "nodePosition");
  if (position == nullptr || position->is_null()) return std::nullopt;
  const std::string map =
      position->is_object() ? Text(*position, "mapId", 0).value_or("") : std::string();
  return Fault{.type = "UNKNOWN_MAP_ID",
               .description = fmt::format("map '{}' is not known: this robot follows routes, and "
                                          "knows no positions",
                                          map),
               .hint = "Leave nodePosition out: a nodeId says where a node is.",
               .references = {{"nodeId", Text(node, "nodeId").value_or("")}, {"mapId", map}}};
}

template <std::size_t kSize>
std::optional<Fault> Unsupported(const Parsed& object, const std::array<const char*, kSize>& names,
                                 const std::string& of) {
  Fault fault{.type = "UNSUPPORTED_PARAMETER", .level = Level::kCritical};
  for (const char* name : names) {
    const Parsed* member = Member(object, name);
    if (member != nullptr && !member->is_null()) fault.references.emplace_back("parameter", name);
  }
  if (fault.references.empty()) return std::nullopt;
  fault.description =
      fmt::format("{} has {}, which this robot cannot see to", of, fault.references.front().second);
  return fault;
}

// `list` has nodes or edges. The first one's sequence is `sequence`, and every second follows.
std::optional<Fault> TakeSteps(const Parsed& message, const char* list, const char* id,
                               std::uint32_t sequence, std::vector<Step>& steps) {
  for (const Parsed& each : message.at(list)) {
    if (!each.is_object()) return Malformed("{} has an entry that is no object", list);
    const auto name = Text(each, id);
    if (!name)
      return Malformed("{} of {} is missing, or no text of 1 to {} bytes", id, list, kMostIdBytes);
    const auto number = Count(each, "sequenceId");
    if (number != sequence) {
      return Malformed("sequenceId of '{}' is not {}: nodes and edges count up by one", *name,
                       sequence);
    }
    const Parsed* released = Member(each, "released");
    if (released == nullptr || !released->is_boolean()) {
      return Malformed("released of '{}' is missing, or neither true nor false", *name);
    }
    if (auto fault = TakeActions(each, *name)) return fault;
    steps.push_back({*name, sequence, released->get<bool>()});
    sequence += 2;
  }
  return std::nullopt;
}

// Checks that released edges have both of their nodes, and come first.
std::optional<Fault> CheckReleased(const Order& order) {
  if (!order.nodes.front().released) return Malformed("the first node is not released");
  for (std::size_t i = 0; i < order.edges.size(); ++i) {
    const Step& edge = order.edges[i];
    const bool on = order.nodes[i].released && order.nodes[i + 1].released;
    if (edge.released != on || (order.nodes[i + 1].released && !order.nodes[i].released)) {
      return Malformed(
          "released of edge '{}' and of its nodes contradict each other: what is released comes "
          "first, and an edge is released with both of its nodes",
          edge.id);
    }
  }
  return std::nullopt;
}

std::optional<Fault> CheckEdges(const Parsed& message, const Order& order, Version version) {
  std::size_t i = 0;
  for (const Parsed& edge : message.at("edges")) {
    const std::string& name = order.edges[i].id;
    if (auto fault = Unsupported(edge, kUnsupportedOfEdge, name)) return fault;
    const bool joins = Text(edge, "startNodeId") == order.nodes[i].id &&
                       Text(edge, "endNodeId") == order.nodes[i + 1].id;
    if (version == Version::k2_1 && !joins) {
      return Malformed(
          "startNodeId and endNodeId of edge '{}' are not the nodes before and after "
          "it, '{}' and '{}'",
          name, order.nodes[i].id, order.nodes[i + 1].id);
    }
    ++i;
  }
  return std::nullopt;
}

std::optional<Fault> Take(const Parsed& message, Version version, Order& order) {
  const Parsed* nodes = Member(message, "nodes");
  const Parsed* edges = Member(message, "edges");
  if (nodes == nullptr || !nodes->is_array() || nodes->empty() || nodes->size() > kMostNodes) {
    return Malformed("nodes is no list of 1 to {}", kMostNodes);
  }
  if (edges == nullptr || !edges->is_array() || edges->size() + 1 != nodes->size()) {
    return Malformed("edges is no list of {}, one fewer than the nodes", nodes->size() - 1);
  }
  constexpr std::uint32_t kHighest =
      std::numeric_limits<std::uint32_t>::max() - 2 * static_cast<std::uint32_t>(kMostNodes);
  const auto first =
      nodes->front().is_object() ? Count(nodes->front(), "sequenceId") : std::nullopt;
  if (!first || *first % 2 != 0 || *first > kHighest) {
    return Malformed("sequenceId of the first node is no even number from 0 to {}", kHighest);
  }
  if (auto fault = TakeSteps(message, "nodes", "nodeId", *first, order.nodes)) return fault;
  if (auto fault = TakeSteps(message, "edges", "edgeId", *first + 1, order.edges)) return fault;
  if (auto fault = CheckReleased(order)) return fault;
  if (auto fault = CheckEdges(message, order, version)) return fault;
  if (auto fault = Unsupported(message, kUnsupportedOfOrder, "the order")) return fault;
  for (const Parsed& node : *nodes) {
    if (auto fault = Unsupported(node)) return fault;
  }
  return std::nullopt;
}

}  // namespace

Fault TooLong(std::string_view topic, std::size_t bytes) {
  return Malformed("a message on {} has {} bytes, at most {} are taken", topic, bytes, kMostBytes);
}

tl::expected<Order, Fault> ParseOrder(const Identity& identity, std::string_view payload) {
  auto message = ParseMessage(identity, "order", payload);
  if (!message) return Refused(message.error());
  Order order;
  const auto id = Text(*message, "orderId");
  if (!id) {
    return Refused(Malformed("orderId is missing, or no text of 1 to {} bytes", kMostIdBytes));
  }
  order.id = *id;
  const auto update = Count(*message, "orderUpdateId");
  std::optional<Fault> fault;
  if (update) {
    order.update = *update;
    fault = Take(*message, identity.version, order);
  } else {
    fault = Malformed("orderUpdateId is missing, or no whole number from 0");
  }
  if (fault) {
    fault->references.emplace_back("orderId", order.id);
    if (update) fault->references.emplace_back("orderUpdateId", fmt::to_string(order.update));
    return Refused(*std::move(fault));
  }
  message->erase("headerId");
  message->erase("timestamp");
  order.content = message->dump(-1, ' ', false, Parsed::error_handler_t::replace);
  return order;
}

tl::expected<std::vector<Action>, Fault> ParseInstantActions(const Identity& identity,
                                                             std::string_view payload) {
  const auto refused = [](Fault fault) {
    fault.references.emplace_back("topic", "instantActions");
    return Refused(std::move(fault));
  };
  const auto message = ParseMessage(identity, "instantActions", payload);
  if (!message) return refused(message.error());
  const Parsed* list = Member(*message, "actions");
  if (list == nullptr || !list->is_array() || list->size() > kMostActions) {
    return refused(Malformed("actions is no list of at most {}", kMostActions));
  }
  std::vector<Action> actions;
  for (const Parsed& each : *list) {
    const auto type = each.is_object() ? Text(each, "actionType") : std::nullopt;
    const auto id = each.is_object() ? Text(each, "actionId") : std::nullopt;
    if (!type || !id) {
      return refused(
          Malformed("an action has no actionType or no actionId of 1 to {} bytes", kMostIdBytes));
    }
    Action action{*type, *id};
    const Parsed* parameters = Member(each, "actionParameters");
    if (parameters != nullptr && !parameters->is_array() && !parameters->is_null()) {
      return refused(Malformed("actionParameters of '{}' is no list", *id));
    }
    for (const Parsed& parameter : parameters != nullptr ? *parameters : Parsed::array()) {
      if (!parameter.is_object() || Text(parameter, "key") != "orderId") continue;
      const auto order = Text(parameter, "value");
      if (!order) return refused(Malformed("orderId of '{}' is no text", *id));
      action.order = *order;
    }
    actions.push_back(std::move(action));
  }
  return actions;
}

}  // namespace trailcast::vda5050
