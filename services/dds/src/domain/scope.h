#pragma once

#include <string>
#include <vector>

#include "services/dds/dds_exchange.h"
#include "services/route/route.h"

namespace trailcast::dds {

// Samples of the topics to which one listens by route travel in one of 32 scopes, DDS partitions,
// by their route: a network without multicast sends each sample to every reader of its partition.
// Not a partition a route: partitions cannot be changed, so each would be a writer and a reader
// more, which every participant is told of, and which would have to go at some time; of 32 writers
// none ever has to, and of the segments of two routes that are fetched at once 3 % go to the wrong
// one, which throws them away.

inline constexpr const char* kEverybody = "";  // no scope

// "00" to "1f".
[[nodiscard]] std::string ScopeOf(const route::RouteKey& route);

// Keys of before there were scopes allow neither those nor the topics that came with them.
[[nodiscard]] bool MayUse(const DdsOptions& self, exchange::Topic topic);

// In which partition `self` writes in a scope. With keys of before there were scopes, which allow
// none: for everybody.
[[nodiscard]] std::string WritersPartition(const DdsOptions& self, const std::string& scope);
// In which partitions who listens to a scope reads: what is written in it, and for everybody.
[[nodiscard]] std::vector<std::string> ListenersPartitions(const DdsOptions& self,
                                                           const std::string& scope);
// In which partitions who reads all of a topic reads.
[[nodiscard]] std::vector<std::string> ReadersPartitions(const DdsOptions& self,
                                                         exchange::Topic topic);

}  // namespace trailcast::dds
