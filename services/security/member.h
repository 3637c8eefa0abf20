#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "services/security/role.h"

namespace trailcast::security {

// A member of the fleet as the others know it. Certificates and permissions travel unencrypted
// while members authenticate, so they have no names: `id` stands for the name, and only the fleet's
// name key tells which (MemberIdOf).
struct Member {
  Role role = Role::kObserver;
  std::string id;                // 16 hexadecimal digits
  std::uint32_t generation = 1;  // rises with each renewal; keys of different generations do not
                                 // mix
  bool operator==(const Member&) const = default;
};

// These convert to and from the common name in a member's certificate, "scout.4f2a9c0d11223344.3".
[[nodiscard]] std::string CommonNameOf(const Member& member);
[[nodiscard]] std::optional<Member> ParseCommonName(std::string_view text);
// Returns the subject as Cyclone compares it with the permissions: "CN=scout.4f2a9c0d11223344.3".
[[nodiscard]] std::string SubjectOf(const Member& member);

// Returns the DDS partition in which the member writes, "scout/4f2a9c0d11223344". It may also write
// in those below, "scout/4f2a9c0d11223344/1f". Nobody else may, so the partition tells a reader who
// wrote a sample.
[[nodiscard]] std::string PartitionOf(const Member& member);
// This matches, for readers, the members' own partitions without those below.
inline constexpr const char* kPartitionsWithoutScope = "*/????????????????";
// Returns whose partition it is, or is below, without the generation.
[[nodiscard]] std::optional<Member> ParsePartition(std::string_view text);

// `name_key` is the fleet's, which only members have.
[[nodiscard]] std::string MemberIdOf(std::string_view name_key, std::string_view name);

}  // namespace trailcast::security
