#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "services/base/result.h"
#include "services/vda5050/protocol.h"

namespace trailcast::vda5050 {

// A node or an edge of an order. Both count by one sequence: nodes are even, edges odd.
struct Step {
  std::string id{};
  std::uint32_t sequence = 0;
  bool released = false;
  bool operator==(const Step&) const = default;
};

struct Order {
  std::string id{};
  std::uint32_t update = 0;
  std::vector<Step> nodes{};  // one or more; the first is released
  std::vector<Step> edges{};  // one fewer
  std::string content{};      // all of it but its header's number and time, to be compared
};

// Reads what came on the topic `order`, from anybody. The fault says why it is refused:
// VALIDATION_FAILURE, or UNSUPPORTED_PARAMETER, INVALID_ORDER_ACTION or UNKNOWN_MAP_ID for what a
// robot that follows routes cannot do.
[[nodiscard]] tl::expected<Order, Fault> ParseOrder(const Identity& identity,
                                                    std::string_view payload);

struct Action {
  std::string type{};
  std::string id{};
  std::string order{};  // the parameter orderId; may be empty
};

// Reads what came on the topic `instantActions`. VALIDATION_FAILURE.
[[nodiscard]] tl::expected<std::vector<Action>, Fault> ParseInstantActions(
    const Identity& identity, std::string_view payload);

// Returns the refusal of a message of so many bytes, which are more than kMostBytes.
[[nodiscard]] Fault TooLong(std::string_view topic, std::size_t bytes);

}  // namespace trailcast::vda5050
