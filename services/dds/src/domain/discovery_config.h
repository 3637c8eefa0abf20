#pragma once

#include <cstdint>
#include <string>

#include "services/dds/dds_exchange.h"

namespace trailcast::dds {

// How a process is to join: decided anew each time that it does.
struct Meeting {
  bool star = false;         // else a mesh
  bool fixed_ports = false;  // those at which others know a route server
  bool sends_much = false;   // segments, not only what is small
  std::string address{};  // of the interface to go by where none is named; empty: Cyclone chooses
};

// Cyclone's XML for whom to meet, as a configuration of its own. Resolves the server addresses:
// kUnavailable names one that has none at present.
[[nodiscard]] Result<std::string> DiscoveryConfig(const DdsOptions& options,
                                                  const Meeting& meeting);

// Nobody on this machine has the ports of a domain's route server.
[[nodiscard]] bool FixedPortsAreFree(std::uint32_t domain_id);

}  // namespace trailcast::dds
