#include "services/dds/src/ros2/ros2_network.h"

#include <fmt/format.h>
#include <ifaddrs.h>
#include <net/if.h>

#include "services/dds/src/domain/cyclone_uri.h"

namespace trailcast::dds {
namespace {

// The participant is announced every second, because a node that starts later and knows no peers
// would otherwise be met after some eight seconds.
constexpr const char* kLocalhost =
    "<Discovery><MaxAutoParticipantIndex>32</MaxAutoParticipantIndex>"
    "<SPDPInterval>1s</SPDPInterval><Peers><Peer Address=\"localhost\"/></Peers></Discovery>";
constexpr const char* kLoopback = "<NetworkInterface name=\"lo\" multicast=\"true\"/>";
constexpr const char* kNetworks = "<NetworkInterface autodetermine=\"true\"/>";

bool HasANetwork() {
  ifaddrs* list = nullptr;
  if (getifaddrs(&list) != 0) return false;
  bool found = false;
  for (const ifaddrs* each = list; each != nullptr; each = each->ifa_next) {
    found = found || (each->ifa_addr != nullptr && each->ifa_addr->sa_family == AF_INET &&
                      (each->ifa_flags & IFF_UP) != 0 && (each->ifa_flags & IFF_LOOPBACK) == 0);
  }
  freeifaddrs(list);
  return found;
}

std::string Xml(const std::string& interfaces) {
  return fmt::format(
      "<CycloneDDS><Domain>{}{}</Domain></CycloneDDS>",
      interfaces.empty() ? "" : "<General><Interfaces>" + interfaces + "</Interfaces></General>",
      kLocalhost);
}

}  // namespace

Ros2Network MeetRos2(const std::string& wanted, const std::string& uri_xml) {
  if (ChoosesInterfaces(uri_xml)) {
    return {Xml(""),
            "the interfaces that CYCLONEDDS_URI names" + (wanted.empty() ? "" : " and " + wanted)};
  }
  if (wanted == "lo") {
    return {Xml(""),
            "the loopback interface alone, where nodes with ROS 2's own defaults or "
            "ROS_AUTOMATIC_DISCOVERY_RANGE=LOCALHOST are not heard: leave out --ros-interface lo "
            "(or --network-interface lo)"};
  }
  if (!wanted.empty()) return {Xml(kLoopback), "the interfaces " + wanted + " and lo"};
  // Cyclone uses the loopback by itself if there is nothing else.
  if (!HasANetwork()) return {Xml(""), "the loopback interface: there is no other"};
  return {Xml(std::string(kNetworks) + kLoopback), "the network's interface and the loopback"};
}

}  // namespace trailcast::dds
