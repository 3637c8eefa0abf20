#include "services/dds/src/domain/discovery_config.h"

#include <arpa/inet.h>
#include <netdb.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <memory>

namespace trailcast::dds {
namespace {

// These are the ports of the DDSI specification: of a domain, and within it.
constexpr std::uint32_t kPorts = 7400;
constexpr std::uint32_t kPortsOfADomain = 250;
constexpr std::uint32_t kServerMeta = 10;  // participant 0, unicast
constexpr std::uint32_t kServerData = 11;
// A star's members listen for servers at another group and port than a mesh uses. On Linux a socket
// of that port would otherwise receive every group that any process of the machine has joined.
constexpr std::uint32_t kStarMeta = 2;
constexpr const char* kMeshGroup = "239.255.0.1";  // Cyclone's
constexpr const char* kStarGroup = "239.255.0.2";

std::uint32_t PortOf(std::uint32_t domain_id, std::uint32_t offset) {
  return kPorts + kPortsOfADomain * domain_id + offset;
}

std::string Peer(const std::string& address, std::uint32_t port) {
  return fmt::format("<Peer Address=\"{}:{}\"/>", address, port);
}

// Cyclone silently ignores a name without an address, and never tries again.
Result<std::string> ServerPeers(const DdsOptions& options) {
  std::string peers;
  for (const std::string& address : options.server_addresses) {
    addrinfo hints{};
    hints.ai_family = AF_INET;
    hints.ai_socktype = SOCK_DGRAM;
    addrinfo* found = nullptr;
    if (const int failed = getaddrinfo(address.c_str(), nullptr, &hints, &found); failed != 0) {
      return Fail(ErrorCode::kUnavailable, "the server address '{}' leads nowhere: {}", address,
                  gai_strerror(failed));
    }
    const std::unique_ptr<addrinfo, decltype(&freeaddrinfo)> all(found, &freeaddrinfo);
    for (const addrinfo* one = all.get(); one != nullptr; one = one->ai_next) {
      char text[INET_ADDRSTRLEN] = "";
      const auto* in = reinterpret_cast<const sockaddr_in*>(one->ai_addr);
      inet_ntop(AF_INET, &in->sin_addr, text, sizeof(text));
      peers += Peer(text, PortOf(options.domain_id, kServerMeta));
    }
  }
  return peers;
}

bool IsFree(std::uint32_t port) {
  const int handle = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  sockaddr_in any{};
  any.sin_family = AF_INET;
  any.sin_port = htons(static_cast<std::uint16_t>(port));
  const bool bound = bind(handle, reinterpret_cast<const sockaddr*>(&any), sizeof(any)) == 0;
  close(handle);
  return bound;
}

}  // namespace

Result<std::string> DiscoveryConfig(const DdsOptions& options, const Meeting& meeting) {
  const auto servers = ServerPeers(options);
  if (!servers) return servers;
  const std::uint32_t domain = options.domain_id;
  std::string general;
  std::string discovery;
  std::string peers = *servers;
  std::string internal;
  if (meeting.star && !servers->empty()) {
    // Addresses are given where multicast does not work, so data must not use it either.
    general = "<AllowMulticast>false</AllowMulticast>";
  } else if (meeting.star) {
    // Members of a star have no group of their own to call in and to hear others. Data may still
    // use multicast, to the star's group, if the network has it; on Wi-Fi Cyclone avoids it.
    discovery = fmt::format(
        "<SPDPMulticastAddress>0.0.0.0</SPDPMulticastAddress>"
        "<DefaultMulticastAddress>{}</DefaultMulticastAddress>"
        "<Ports><MulticastMetaOffset>{}</MulticastMetaOffset></Ports>",
        kStarGroup, kStarMeta);
    peers = Peer(kMeshGroup, PortOf(domain, 0));
    // All members answer a server that starts, but not all at once.
    internal = "<SPDPResponseMaxDelay>200ms</SPDPResponseMaxDelay>";
  }
  // A star's members may have called before this process could answer, so it calls them.
  if (!meeting.star) peers += Peer(kStarGroup, PortOf(domain, kStarMeta));
  if (meeting.fixed_ports) discovery += "<ParticipantIndex>0</ParticipantIndex>";
  if (!peers.empty()) discovery += "<Peers>" + peers + "</Peers>";
  return fmt::format(
      "<CycloneDDS><Domain><General>{}</General><Discovery>{}</Discovery><Internal>{}</Internal>"
      "</Domain></CycloneDDS>",
      general, discovery, internal);
}

bool FixedPortsAreFree(std::uint32_t domain_id) {
  return IsFree(PortOf(domain_id, kServerMeta)) && IsFree(PortOf(domain_id, kServerData));
}

}  // namespace trailcast::dds
