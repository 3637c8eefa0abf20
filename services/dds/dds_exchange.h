#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "services/base/ids.h"
#include "services/base/result.h"
#include "services/dds/protocol_version.h"
#include "services/exchange/network_state.h"
#include "services/exchange/route_exchange.h"
#include "services/security/member_keys.h"

namespace trailcast::dds {

// How a process meets others. If everybody discovers everybody, the cost is the square of their
// number. In a star round the route servers, each member pays the same however large the fleet is.
enum class Discovery : std::uint8_t {
  kMesh,  // everybody, by multicast
  kStar,  // route servers, and members of a mesh: calls them by multicast or at their addresses,
          // and does not hear others call
  kAuto,  // a star; without a server within some seconds it becomes a mesh, until one appears
};

class Domain;

// Lets several exchanges of one process, opened one after another, share the threads and the
// sockets of the first, with its options. They do not hear each other. A process can thus be many
// light members.
struct SharedDomain {
  std::weak_ptr<Domain> domain;
  std::string by;  // the network interface and the servers for which it was made
};

struct DdsOptions {
  std::uint32_t domain_id = 0;  // 0..230; decides the UDP ports
  // Participants with different tags do not see each other: two swarms, or two tests, share a
  // network this way.
  std::string discovery_tag;
  // If it is empty, the best interface with an IPv4 address is chosen, but never the loopback,
  // which only "lo" selects. If the interface disappears or gets another address, the exchange
  // leaves and joins again, as with new keys.
  std::string network_interface;
  // If there is no network yet, or no server's name has an address, the exchange waits instead of
  // failing. If some have one, it goes by those, and looks the others up again and again.
  bool waits_for_network = false;
  // Called with a line when the exchange waits, when it has joined, and for each change after that.
  // OpenDdsExchange and Take call it.
  std::function<void(const std::string& line)> tell_of_network{};
  // These functions keep it up to date, on the thread that calls them; it may be null.
  std::shared_ptr<exchange::NetworkState> network_state{};
  // DDS tools show it in the participant's user data, beside the protocol's version, but not with
  // keys, because user data is not encrypted.
  AgentId self;
  std::string extra_config_xml;  // XML for Cyclone that overrides everything else

  Discovery discovery = Discovery::kMesh;
  // Marks a route server, the centre of a star. It is in every mesh, too. It uses the fixed ports
  // of its domain (7410 and 7411, 250 more for each domain above 0) if those are free on this
  // machine.
  bool serves = false;
  // Names or IPv4 addresses of route servers, to reach them where there is no multicast. Names at
  // whose addresses no server is heard are looked up again. If one has another address then, the
  // exchange joins again.
  std::vector<std::string> server_addresses{};
  // Called with how others are met, if that differs from the request or changes. OpenDdsExchange
  // and Take call it.
  std::function<void(const std::string& line)> tell_of_discovery{};

  // With keys, the exchange uses DDS Security as their member; without, it is open to everybody. It
  // joins again within seconds if the folder's files change (renewed keys, a new list of revoked
  // ones), or if a route server gives a newer list, which is written into the folder. Recent
  // publications may then have to be repeated. A server gives its list to all.
  std::optional<security::MemberKeys> keys;
  // Called for each participant that was kept out, with the reason, once and again after ten
  // minutes; and for new keys. Take calls it.
  std::function<void(const std::string& line)> tell_of_stranger{};

  // Called for participants with another version of the protocol, once and again after ten minutes.
  // On the topics that changed they do not hear this program, or are not heard. Take calls it.
  std::function<void(const std::string& line)> tell_of_version{};
  std::uint32_t protocol_version = kProtocolVersion;  // tests set others

  std::shared_ptr<SharedDomain> shared_domain{};

  // How long closing waits for the last messages to arrive. Publish never waits.
  std::chrono::milliseconds close_timeout{1000};
};

// Opens the bus over Cyclone DDS, as one participant with the topics of `use`; qos_table.cc has
// their QoS. kUnavailable means that there is no network, and waits_for_network is not set. Members
// that were heard before the exchange joined again, and are not heard within ten seconds after
// that, are reported as gone. The destructor withdraws the statuses that it published (the others
// get AgentGone), after it has waited at most close_timeout for its last messages to arrive.
[[nodiscard]] Result<std::unique_ptr<exchange::RouteExchange>> OpenDdsExchange(
    const DdsOptions& options, const exchange::TopicUse& use);

}  // namespace trailcast::dds
