#include "services/dds/src/domain/interfaces.h"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <netinet/in.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <set>

namespace trailcast::dds {
namespace {

Interface WithoutAddress(const ifaddrs& entry) {
  Interface interface;
  interface.name = entry.ifa_name;
  interface.index = if_nametoindex(entry.ifa_name);
  interface.up = (entry.ifa_flags & IFF_UP) != 0;
  interface.connected = (entry.ifa_flags & IFF_RUNNING) != 0;
  interface.loopback = (entry.ifa_flags & IFF_LOOPBACK) != 0;
  interface.multicast = (entry.ifa_flags & IFF_MULTICAST) != 0;
  std::error_code none;
  interface.hardware =
      std::filesystem::exists("/sys/class/net/" + interface.name + "/device", none);
  return interface;
}

bool LeadsBeyondItsLink(const ifaddrs& entry) {
  const auto* in = reinterpret_cast<const sockaddr_in6*>(entry.ifa_addr);
  return !IN6_IS_ADDR_LINKLOCAL(&in->sin6_addr) && !IN6_IS_ADDR_LOOPBACK(&in->sin6_addr);
}

std::string AddressOf(const ifaddrs& entry) {
  char text[INET_ADDRSTRLEN] = "";
  const auto* in = reinterpret_cast<const sockaddr_in*>(entry.ifa_addr);
  inet_ntop(AF_INET, &in->sin_addr, text, sizeof(text));
  return text;
}

}  // namespace

std::vector<Interface> Interfaces() {
  ifaddrs* list = nullptr;
  if (getifaddrs(&list) != 0) return {};
  const std::unique_ptr<ifaddrs, decltype(&freeifaddrs)> all(list, &freeifaddrs);
  std::vector<Interface> interfaces;
  std::set<std::string> with_ipv6;
  for (const ifaddrs* each = list; each != nullptr; each = each->ifa_next) {
    const int family = each->ifa_addr == nullptr ? AF_PACKET : each->ifa_addr->sa_family;
    if (family == AF_INET6 && LeadsBeyondItsLink(*each)) with_ipv6.insert(each->ifa_name);
    if (family == AF_INET6) continue;
    const auto known =
        std::find_if(interfaces.begin(), interfaces.end(),
                     [&](const Interface& one) { return one.name == each->ifa_name; });
    if (family != AF_INET) {
      if (known == interfaces.end()) interfaces.push_back(WithoutAddress(*each));
    } else if (known != interfaces.end() && known->address.empty()) {
      known->address = AddressOf(*each);
    } else {
      interfaces.push_back(WithoutAddress(*each));
      interfaces.back().address = AddressOf(*each);
    }
  }
  for (Interface& interface : interfaces) interface.ipv6 = with_ipv6.contains(interface.name);
  return interfaces;
}

std::string ToText(const std::vector<Interface>& interfaces) {
  std::string text;
  for (const Interface& each : interfaces) {
    text += fmt::format("{}{} ({})", text.empty() ? "" : ", ", each.name, each.address);
  }
  return text;
}

}  // namespace trailcast::dds
