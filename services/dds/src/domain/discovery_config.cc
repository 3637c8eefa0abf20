#include "services/dds/src/domain/discovery_config.h"

#include <fmt/format.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

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

std::string ServerAt(const std::string& address, std::uint32_t domain_id) {
  return fmt::format("{}:{}", address, PortOf(domain_id, kServerMeta));
}

std::string DiscoveryConfig(const DdsOptions& options, const Meeting& meeting) {
  const std::uint32_t domain = options.domain_id;
  std::string general;
  std::string discovery;
  std::string peers;
  for (const std::string& address : meeting.servers) {
    peers += Peer(address, PortOf(domain, kServerMeta));
  }
  std::string internal;
  if (meeting.star && !meeting.servers.empty()) {
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
