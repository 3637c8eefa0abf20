// This part of Vehicle takes a fleet manager's orders, or says why it does not.
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "services/vda5050/vehicle.h"

namespace trailcast::vda5050 {
namespace {

Fault OrderFault(const char* type, const Order& order, std::string description,
                 std::string hint = {}) {
  return {.type = type,
          .description = std::move(description),
          .hint = std::move(hint),
          .references = {{"orderId", order.id}, {"orderUpdateId", fmt::to_string(order.update)}}};
}

}  // namespace

void Vehicle::TakeOrder(std::string_view payload, const Graph* graph, Time now) {
  state_asked_ = true;
  auto order = ParseOrder(identity_, payload);
  if (!order) {
    rejected_ = order.error();
    return;
  }
  const bool is_update = held_ && held_->order.id == order->id;
  if (is_update && order->update == held_->order.update && order->content == held_->order.content) {
    return;  // said again
  }
  // A robot on its way may be out of reach for a while.
  const bool is_there = (is_update && IsActive()) || ConnectionAt(now) == Connection::kOnline;
  std::optional<Fault> refused;
  if (!is_there || ModeNow() != Mode::kAutomatic) {
    refused = OrderFault(
        "MOBILE_ROBOT_NOT_AVAILABLE", *order,
        !is_there ? identity_.serial + " is not heard"
        : !foreign_.empty()
            ? fmt::format("{} does mission {} of another sender", identity_.serial, foreign_)
            : fmt::format("{} takes no orders now: {}", identity_.serial,
                          status_.on_duty ? status_.detail : "it is not on duty"),
        "Its agent has to run as 'trailcast-agent serve', and to be free.");
  } else {
    refused = is_update ? TakeUpdate(*std::move(order), graph) : TakeNew(*std::move(order), graph);
  }
  if (refused) rejected_ = *std::move(refused);
}

std::optional<Fault> Vehicle::CheckNodes(const Order& order, const Graph* graph) const {
  if (graph == nullptr) {
    return OrderFault("NO_ROUTE_TO_TARGET", order,
                      "no route server has told the network of routes yet",
                      "Is trailcast-server running, with the same --domain and --dds-tag?");
  }
  std::optional<Graph::Node> before;
  for (const Step& step : order.nodes) {
    auto node = graph->Find(step.id);
    if (!node) return OrderFault("NO_ROUTE_TO_TARGET", order, node.error().message);
    if (before) {
      const auto way = graph->WayBetween(before->place, node->place);
      if (!way) return OrderFault("NO_ROUTE_TO_TARGET", order, way.error().message);
    }
    before = *std::move(node);
  }
  return std::nullopt;
}

std::optional<Fault> Vehicle::TakeNew(Order order, const Graph* graph) {
  if (IsActive()) {
    return OrderFault("OTHER_ORDER_ACTIVE", order,
                      fmt::format("order '{}' is not done yet", held_->order.id),
                      "Wait for it, or send cancelOrder.");
  }
  if (order.update != 0 && identity_.version == Version::k3_0) {
    return OrderFault(
        "VALIDATION_FAILURE", order,
        "a new order begins with orderUpdateId 0: what came before is not known here");
  }
  if (auto fault = CheckNodes(order, graph)) return fault;
  const auto first = graph->Find(order.nodes.front().id);
  if (stood_ && !graph->IsOn(*stood_, first->place)) {
    return OrderFault("START_NODE_OUT_OF_RANGE", order,
                      fmt::format("{} stands {:.1f} m along {}, not on node '{}'", identity_.serial,
                                  stood_->along_m, stood_->route, order.nodes.front().id),
                      fmt::format("Begin with a node within {:g} m of it; it has said so of node "
                                  "'{}'.",
                                  Graph::kOnNode_m,
                                  graph->NodeAt(*stood_).value_or(
                                      fmt::format("{}:{:.2f}", stood_->route, stood_->along_m))));
  }
  held_ = Held{.order = std::move(order)};
  NoteReached(0);
  // 2.1 tells instant actions among an order's.
  if (identity_.version == Version::k2_1) ClearActions();
  unreachable_.reset();
  disobeyed_.reset();
  Accepted();
  return std::nullopt;
}

std::optional<Fault> Vehicle::TakeUpdate(Order order, const Graph* graph) {
  Order& held = held_->order;
  if (order.update == held.update) {
    return OrderFault("SAME_ORDER_UPDATE_ID", order, "another content has come with this number");
  }
  if (order.update < held.update) {
    return OrderFault("OUTDATED_ORDER_UPDATE", order,
                      fmt::format("update {} has been taken already", held.update));
  }
  if (held_->cancelled) {
    return OrderFault("ORDER_UPDATE_FOLLOWING_CANCEL", order, "this order was cancelled",
                      "Send a new order.");
  }
  const std::size_t last = LastReleased();
  if (order.nodes.front().id != held.nodes[last].id ||
      order.nodes.front().sequence != held.nodes[last].sequence) {
    return OrderFault("VALIDATION_FAILURE", order,
                      fmt::format("it does not begin with the last released node, '{}' of "
                                  "sequenceId {}",
                                  held.nodes[last].id, held.nodes[last].sequence));
  }
  if (auto fault = CheckNodes(order, graph)) return fault;
  held.nodes.resize(last + 1);
  held.edges.resize(last);
  if (held.nodes.size() + order.nodes.size() > 2 * kMostNodes) {
    // The nodes behind the robot are no longer needed.
    held.nodes.erase(held.nodes.begin(),
                     held.nodes.begin() + static_cast<std::ptrdiff_t>(held_->at));
    held.edges.erase(held.edges.begin(),
                     held.edges.begin() + static_cast<std::ptrdiff_t>(held_->at));
    if (leg_) {
      for (Leg::Mark& mark : leg_->marks) mark.node -= std::min(mark.node, held_->at);
    }
    held_->at = 0;
  }
  held.nodes.insert(held.nodes.end(), order.nodes.begin() + 1, order.nodes.end());
  held.edges.insert(held.edges.end(), order.edges.begin(), order.edges.end());
  held.update = order.update;
  held.content = std::move(order.content);
  held_->active = true;
  if (held_->at + 1 == held.nodes.size()) held_->active = false;
  Accepted();
  return std::nullopt;
}

void Vehicle::Accepted() {
  rejected_.reset();
  no_cancel_.reset();
}

void Vehicle::NoteReached(std::size_t node) {
  held_->at = node;
  last_node_ = held_->order.nodes[node].id;
  held_->active = node + 1 < held_->order.nodes.size();
}

}  // namespace trailcast::vda5050
