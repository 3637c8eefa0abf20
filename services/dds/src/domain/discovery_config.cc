#include "services/dds/src/domain/discovery_config.h"

#include <arpa/inet.h>
#include <netdb.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <memory>

namespace trailcast::dds {
namespace {

// The ports of the DDSI specification: of a domain, and in it.
constexpr std::uint32_t kPorts = 7400;
constexpr std::uint32_t kPortsOfADomain = 250;
constexpr std::uint32_t kServerMeta = 10;  // participant 0, unicast
constexpr std::uint32_t kServerData = 11;
// A star's members listen for servers at another group and port than where a mesh meets: on Linux a
// socket of that port hears whatever group any process of the machine has joined.
constexpr std::uint32_t kStarMeta = 2;
constexpr const char* kMeshGroup = "239.255.0.1";  // Cyclone's
constexpr const char* kStarGroup = "239.255.0.2";

std::uint32_t PortOf(std::uint32_t domain_id, std::uint32_t offset) {
  return kPorts + kPortsOfADomain * domain_id + offset;
}

std::string Peer(const std::string& address, std::uint32_t port) {
  return fmt::format("<Peer Address=\"{}:{}\"/>", address, port);
}

// Cyclone would say nothing of a name that means nothing, and never try again.
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
    // Whoever is told addresses is where multicast does not get through, data neither.
    general = "<AllowMulticast>false</AllowMulticast>";
  } else if (meeting.star) {
    // No group of its own to call in and to hear others. Data may still be multicast, to the
    // star's group, where the network has that: on Wi-Fi Cyclone does not.
    discovery = fmt::format(
        "<SPDPMulticastAddress>0.0.0.0</SPDPMulticastAddress>"
        "<DefaultMulticastAddress>{}</DefaultMulticastAddress>"
        "<Ports><MulticastMetaOffset>{}</MulticastMetaOffset></Ports>",
        kStarGroup, kStarMeta);
    peers = Peer(kMeshGroup, PortOf(domain, 0));
    // A server that starts is answered by all, not all at once.
    internal = "<SPDPResponseMaxDelay>200ms</SPDPResponseMaxDelay>";
  }
  // Whoever starts here may have heard a star's members before it could answer: it calls them.
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
