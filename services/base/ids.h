#pragma once

#include <compare>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>

namespace trailcast {

// A value that the compiler does not confuse with another one of the same representation.
template <typename Tag, typename Value>
class Id {
 public:
  Id() = default;
  explicit Id(Value value) : value_(std::move(value)) {}
  [[nodiscard]] const Value& value() const { return value_; }
  // NOLINTNEXTLINE(modernize-use-nullptr): clang-tidy 14 misreads a defaulted <=>
  auto operator<=>(const Id&) const = default;

 private:
  Value value_{};
};

// A route's identity, given once when teaching begins and never reused: 32 lower-case hexadecimal
// digits.
using RouteId = Id<struct RouteIdTag, std::string>;
// One teaching of a route. It is drawn at random when teaching begins, so that no two robots draw
// the same: 1 to 2^63 - 1.
using TeachingId = Id<struct TeachingIdTag, std::uint64_t>;
// The number by which people name a teaching: 1, 2, .. in the order in which a route's teachings
// arrived at the server. 0 means that none was given yet.
using RevisionNumber = Id<struct RevisionNumberTag, std::uint32_t>;
// The position of a segment in its route, from 0.
using SegmentIndex = Id<struct SegmentIndexTag, std::uint32_t>;
// The name of an agent or a server, unique in the fleet: 1 to 64 of [A-Za-z0-9_.-].
using AgentId = Id<struct AgentIdTag, std::string>;

// Draws 32 hexadecimal digits from the system's random source.
[[nodiscard]] RouteId MakeRouteId();
// Draws from the system's random source.
[[nodiscard]] TeachingId MakeTeachingId();

// Says whether a name is made of 1 to 64 of [A-Za-z0-9_.-], as the names of agents, routes and
// servers are.
[[nodiscard]] bool IsValidName(const std::string& name);

}  // namespace trailcast

template <typename Tag, typename Value>
struct std::hash<trailcast::Id<Tag, Value>> {
  std::size_t operator()(const trailcast::Id<Tag, Value>& id) const noexcept {
    return std::hash<Value>{}(id.value());
  }
};
