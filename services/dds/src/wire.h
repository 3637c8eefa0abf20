#pragma once

#include <dds/dds.h>

#include <cstdint>
#include <functional>

#include "services/base/result.h"
#include "services/exchange/messages.h"
#include "services/exchange/route_exchange.h"

namespace trailcast::dds {

// These convert between our messages and the C structs that idlc makes of idl/trailcast.idl.

inline constexpr std::uint8_t kUnknownPercent = 255;
inline constexpr std::uint8_t kDoesNotFollow = 255;

[[nodiscard]] const dds_topic_descriptor_t& TypeOf(exchange::Topic topic);

// Calls `use` with the message as a sample of its topic's type. The sample points into the message
// and is valid only during the call. The message must be within bounds (CheckBounds) and not
// AgentGone.
using UseSample = std::function<Result<void>(const void* sample)>;
[[nodiscard]] Result<void> WithWire(const exchange::Message& message, const UseSample& use);

// Returns a copy of a received sample; kInvalidArgument means that something in it is out of
// bounds.
[[nodiscard]] Result<exchange::Message> FromWire(exchange::Topic topic, const void* sample);

// Reads the key fields of a sample of the agents topic.
[[nodiscard]] Result<exchange::AgentGone> GoneFromWire(const void* sample);

}  // namespace trailcast::dds
