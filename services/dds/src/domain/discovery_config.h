#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "services/dds/dds_exchange.h"

namespace trailcast::dds {

// How a process joins. It is decided anew each time.
struct Meeting {
  bool star = false;         // otherwise a mesh
  bool fixed_ports = false;  // the ports at which others expect a route server
  bool sends_much = false;   // segments, not only small messages
  std::string address{};     // of the interface to use if none is named; if empty, Cyclone chooses
  std::vector<std::string> servers{};  // addresses at which to call route servers
};

// Returns Cyclone's XML that tells whom to meet.
[[nodiscard]] std::string DiscoveryConfig(const DdsOptions& options, const Meeting& meeting);

// Returns where a route server with the fixed ports is: "10.0.0.7:7410". It names itself so, too.
[[nodiscard]] std::string ServerAt(const std::string& address, std::uint32_t domain_id);

// Says whether nobody on this machine has the ports of a domain's route server.
[[nodiscard]] bool FixedPortsAreFree(std::uint32_t domain_id);

}  // namespace trailcast::dds
