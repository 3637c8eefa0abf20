#pragma once

#include <string>

namespace trailcast::http {

// Returns the key by which clients are told apart: an IPv4 address as it is, but only the network
// of an IPv6 address, because its owner has 2^64 of them.
[[nodiscard]] std::string AddressKey(const std::string& address);

}  // namespace trailcast::http
