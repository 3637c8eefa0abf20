#pragma once

#include <compare>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>

namespace trailcast {

// A value that cannot be mistaken for another of the same representation.
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

// Given once when teaching begins, never reused: 32 lower-case hexadecimal digits.
using RouteId = Id<struct RouteIdTag, std::string>;
// One teaching of a route, drawn at random when it begins, so that no two robots make the same: 1
// to 2^63 - 1.
using TeachingId = Id<struct TeachingIdTag, std::uint64_t>;
// What people call a teaching by: 1, 2, .. in the order in which teachings of the route arrived at
// the server. 0: none was given yet.
using RevisionNumber = Id<struct RevisionNumberTag, std::uint32_t>;
// Position of a segment in its route, from 0.
using SegmentIndex = Id<struct SegmentIndexTag, std::uint32_t>;
// An agent's (or server's) name, unique in the fleet: [A-Za-z0-9_.-], at most 64 characters.
using AgentId = Id<struct AgentIdTag, std::string>;

// 32 hexadecimal digits from the system's random source.
[[nodiscard]] RouteId MakeRouteId();
// From the system's random source.
[[nodiscard]] TeachingId MakeTeachingId();

// True for names made of 1 to 64 of [A-Za-z0-9_.-]: agents, routes and servers are named so.
[[nodiscard]] bool IsValidName(const std::string& name);

}  // namespace trailcast

template <typename Tag, typename Value>
struct std::hash<trailcast::Id<Tag, Value>> {
  std::size_t operator()(const trailcast::Id<Tag, Value>& id) const noexcept {
    return std::hash<Value>{}(id.value());
  }
};
