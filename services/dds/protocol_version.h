#pragma once

#include <cstdint>

namespace trailcast::dds {

// The version rises whenever a type of idl/trailcast.idl changes. Participants with different
// definitions of a topic do not hear each other on it, and only their versions tell people why.
inline constexpr std::uint32_t kProtocolVersion = 7;

// A participant that does not tell its version has one before this.
inline constexpr std::uint32_t kFirstVersionSaid = 3;

}  // namespace trailcast::dds
