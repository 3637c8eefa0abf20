#include "services/dds/src/domain/scope.h"

#include <fmt/format.h>

#include "services/exchange/topics.h"

namespace trailcast::dds {

std::string ScopeOf(const route::RouteKey& route) {
  constexpr std::uint64_t kScopes = 32;
  return fmt::format("{:02x}", route.teaching.value() % kScopes);
}

bool MayUse(const DdsOptions& self, exchange::Topic topic) {
  using exchange::Topic;
  if (!self.keys) return true;
  if (self.keys->lacks.contains(topic)) return false;
  return self.keys->scoped || (topic != Topic::kFleet && topic != Topic::kNeighbours);
}

std::string WritersPartition(const DdsOptions& self, const std::string& scope) {
  if (!self.keys) return scope;
  const std::string own = security::PartitionOf(self.keys->member);
  return scope == kEverybody || !self.keys->scoped ? own : own + "/" + scope;
}

std::vector<std::string> ListenersPartitions(const DdsOptions& self, const std::string& scope) {
  if (!self.keys) return {scope, kEverybody};
  return {"*/" + scope, security::kPartitionsWithoutScope};
}

std::vector<std::string> ReadersPartitions(const DdsOptions& self, exchange::Topic topic) {
  if (self.keys) return {"*"};
  // Not every DDS matches a writer without a partition with a reader in "*".
  if (exchange::IsOfRoutes(topic)) return {"*", kEverybody};
  return {kEverybody};
}

}  // namespace trailcast::dds
