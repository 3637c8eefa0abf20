#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "services/security/role.h"

namespace trailcast::security {

// A member of the fleet as the others know it. Certificates and permissions travel in the open
// while members greet each other, so they bear no names: `id` stands for the name, and only who
// has the fleet's name key can tell which (MemberIdOf).
struct Member {
  Role role = Role::kObserver;
  std::string id;                // 16 hexadecimal digits
  std::uint32_t generation = 1;  // one more with each renewal; keys of different ones do not mix
  bool operator==(const Member&) const = default;
};

// The common name in a member's certificate, "scout.4f2a9c0d11223344.3", and back.
[[nodiscard]] std::string CommonNameOf(const Member& member);
[[nodiscard]] std::optional<Member> ParseCommonName(std::string_view text);
// As Cyclone compares it with the permissions: "CN=scout.4f2a9c0d11223344.3".
[[nodiscard]] std::string SubjectOf(const Member& member);

// The DDS partition in which the member writes: "scout/4f2a9c0d11223344"; and in those below it,
// "scout/4f2a9c0d11223344/1f". No one else may, so who reads a sample knows whose it is.
[[nodiscard]] std::string PartitionOf(const Member& member);
// The members' own partitions without those below, to those who read.
inline constexpr const char* kPartitionsWithoutScope = "*/????????????????";
// Whose partition it is, or is below; without generation.
[[nodiscard]] std::optional<Member> ParsePartition(std::string_view text);

// `name_key`: the fleet's, which every member has and nobody else.
[[nodiscard]] std::string MemberIdOf(std::string_view name_key, std::string_view name);

}  // namespace trailcast::security
