#pragma once

#include <string>
#include <vector>

#include "services/dds/dds_exchange.h"
#include "services/route/route.h"

namespace trailcast::dds {

// Topics that are listened to by route have 32 scopes, which are DDS partitions; a sample's route
// tells its scope. A network without multicast sends each sample to every reader of its partition.
// A partition for each route would not do: partitions cannot be changed, so every route would need
// a writer and a reader of its own, which every participant is told of and which would have to be
// deleted some time. The 32 writers never have to go. If two routes are fetched at once, 3 % of
// their segments go to the wrong robot, which drops them.

inline constexpr const char* kEverybody = "";  // no scope

// Returns "00" to "1f".
[[nodiscard]] std::string ScopeOf(const route::RouteKey& route);

// Says whether keys allow a topic. Keys from before there were scopes allow neither these nor the
// topics that came with them.
[[nodiscard]] bool MayUse(const DdsOptions& self, exchange::Topic topic);

// Returns the partition in which `self` writes in a scope. Keys from before there were scopes allow
// only the one for everybody.
[[nodiscard]] std::string WritersPartition(const DdsOptions& self, const std::string& scope);
// Returns the partitions that a listener to a scope reads: the scope's, and the one for everybody.
[[nodiscard]] std::vector<std::string> ListenersPartitions(const DdsOptions& self,
                                                           const std::string& scope);
// Returns the partitions that a reader of the whole topic reads.
[[nodiscard]] std::vector<std::string> ReadersPartitions(const DdsOptions& self,
                                                         exchange::Topic topic);

}  // namespace trailcast::dds
