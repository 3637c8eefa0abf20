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

// Whom a process meets. Discovery of all by all costs the square of their number; as a star round
// the route servers, a fleet costs each member the same however large it is.
enum class Discovery : std::uint8_t {
  kMesh,  // everybody, by multicast
  kStar,  // route servers, and who is in a mesh: calls them by multicast or at their addresses, and
          // does not hear others call
  kAuto,  // a star; if no server is there within some seconds of the beginning a mesh, until one is
};

class Domain;

// For several exchanges of one process, opened one after another: they share the threads and the
// sockets of the first, whose options are everybody's, and do not hear each other. So a process can
// be many members that are light.
struct SharedDomain {
  std::weak_ptr<Domain> domain;
  std::string by;  // the network interface that it was made for
};

struct DdsOptions {
  std::uint32_t domain_id = 0;  // 0..230, decides the UDP ports
  // Participants with different tags do not see each other: two swarms, or two tests, on one
  // network.
  std::string discovery_tag;
  // Empty: the best there is, with an IPv4 address, but never the loopback: that is for "lo" alone.
  // When it goes, or has another address, the exchange leaves and joins anew, as with new keys.
  std::string network_interface;
  // Where there is no network yet, or a server's name leads nowhere: wait for it, instead of
  // failing.
  bool waits_for_network = false;
  // Told, in a line each, that it waits, that it has joined, and what has changed since. Called by
  // OpenDdsExchange and Take.
  std::function<void(const std::string& line)> tell_of_network{};
  // Kept up to date by those, for the thread that calls them; null: nobody asks.
  std::shared_ptr<exchange::NetworkState> network_state{};
  // Shown by DDS tools in the participant's user data, beside the version of the protocol; not with
  // keys: it is not encrypted.
  AgentId self;
  std::string extra_config_xml;  // Cyclone's XML, has the last word

  Discovery discovery = Discovery::kMesh;
  // A route server, the centre of a star: in every mesh, too, and at the fixed ports of its domain
  // (7410 and 7411, 250 more for each domain above 0) if those are free on this machine.
  bool serves = false;
  // Of route servers, names or IPv4 addresses, to be met where there is no multicast.
  std::vector<std::string> server_addresses{};
  // Told which way others are met, when that was not what was asked for, or changes. Called by
  // OpenDdsExchange and Take.
  std::function<void(const std::string& line)> tell_of_discovery{};

  // With DDS Security, as the member whose keys these are; without: open to everybody. When the
  // folder's files change (renewed keys, a new list of revoked ones), or a route server gives a
  // newer list, which goes into the folder, the exchange joins anew with them within seconds; what
  // it published lately may then have to be published again. A server gives its list to all.
  std::optional<security::MemberKeys> keys;
  // Told of each who was kept out, and why: once, and again after ten minutes; and of new keys.
  // Called by Take.
  std::function<void(const std::string& line)> tell_of_stranger{};

  // Told of those that speak another version of the protocol, and so do not hear this program, or
  // are not heard, on the topics that changed: once, and again after ten minutes. Called by Take.
  std::function<void(const std::string& line)> tell_of_version{};
  std::uint32_t protocol_version = kProtocolVersion;  // another in tests

  std::shared_ptr<SharedDomain> shared_domain{};

  // How long closing waits for the last messages to arrive. Publish waits for nobody.
  std::chrono::milliseconds close_timeout{1000};
};

// The bus over Cyclone DDS. One participant with the topics of `use`; QoS in qos_table.cc.
// kUnavailable where there is no network to join and it is not to be waited for. Who was heard
// before the exchange joined anew, and is not within ten seconds of that, is told to be gone.
// Destroying it says good-bye for the statuses it published (AgentGone at the others) after
// waiting, at most close_timeout, for its last messages to arrive.
[[nodiscard]] Result<std::unique_ptr<exchange::RouteExchange>> OpenDdsExchange(
    const DdsOptions& options, const exchange::TopicUse& use);

}  // namespace trailcast::dds
