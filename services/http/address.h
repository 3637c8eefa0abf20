#pragma once

#include <string>

namespace trailcast::http {

// By what clients are told apart: an IPv4 address as it is; of an IPv6 address the network, since
// who has one has 2^64.
[[nodiscard]] std::string AddressKey(const std::string& address);

}  // namespace trailcast::http
