#pragma once

#include <cstdint>

namespace trailcast::dds {

// The version rises whenever a type of idl/trailcast.idl changes, or the route format. Participants
// with different definitions of a topic do not hear each other on it, nobody follows segments in
// another format, and only the versions tell people why.
inline constexpr std::uint32_t kProtocolVersion = 9;

// A participant that does not tell its version has one before this.
inline constexpr std::uint32_t kFirstVersionSaid = 3;

}  // namespace trailcast::dds
