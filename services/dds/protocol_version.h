#pragma once

#include <cstdint>

namespace trailcast::dds {

// One more whenever a type of idl/trailcast.idl changes: who has another definition of a topic is
// not heard on it, and what versions say of each other is all that tells people why.
inline constexpr std::uint32_t kProtocolVersion = 7;

// Who does not say its version is of before this one.
inline constexpr std::uint32_t kFirstVersionSaid = 3;

}  // namespace trailcast::dds
