#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "services/dds/src/entities.h"
#include "services/exchange/route_exchange.h"

namespace trailcast::dds {

// A topic's QoS, the same for its writers and its readers, except for readers that overhear it.
struct TopicQos {
  bool transient_local;                  // late joiners get the latest sample per key
  int keep_last;                         // samples per key; no writer waits for slow readers
  std::chrono::milliseconds liveliness;  // how long a silent writer's samples stay valid; 0 means
                                         // for ever
  bool best_effort = false;              // for what is repeated soon
};

[[nodiscard]] const TopicQos& QosOf(exchange::Topic topic);
// Revocations are no topic of the exchange; each server's newest list is kept.
inline constexpr TopicQos kRevocationsQos{true, 1, std::chrono::milliseconds(0)};

// `partitions` are those in which it writes or reads; "" is the default one.
[[nodiscard]] Qos MakeQos(const TopicQos& of, const std::vector<std::string>& partitions = {""});
// Returns the QoS of a reader that overhears: best-effort, without anything that was written
// before.
[[nodiscard]] Qos MakeOverhearingQos(const TopicQos& of,
                                     const std::vector<std::string>& partitions = {""});

}  // namespace trailcast::dds
