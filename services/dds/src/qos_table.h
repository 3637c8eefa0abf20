#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "services/dds/src/entities.h"
#include "services/exchange/route_exchange.h"

namespace trailcast::dds {

// A topic's QoS, for its writers and its readers alike. But for who overhears it.
struct TopicQos {
  bool transient_local;                  // late joiners get the latest sample per key
  int keep_last;                         // samples per key; nobody waits for slow readers
  std::chrono::milliseconds liveliness;  // a silent writer's samples are over after this; 0: never
  bool best_effort = false;              // soon said again
};

[[nodiscard]] const TopicQos& QosOf(exchange::Topic topic);
// Revocations are no topic of the exchange: lists of keys, of each server its newest.
inline constexpr TopicQos kRevocationsQos{true, 1, std::chrono::milliseconds(0)};

// `partitions`: in which it writes or reads; "" is the default one.
[[nodiscard]] Qos MakeQos(const TopicQos& of, const std::vector<std::string>& partitions = {""});
// For a reader that overhears: best-effort, and nothing of what was written before it.
[[nodiscard]] Qos MakeOverhearingQos(const TopicQos& of,
                                     const std::vector<std::string>& partitions = {""});

}  // namespace trailcast::dds
