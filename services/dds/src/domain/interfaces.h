#pragma once

#include <string>
#include <vector>

namespace trailcast::dds {

// An IPv4 address of a network interface of this machine, or an interface that has none.
struct Interface {
  std::string name;
  unsigned index = 0;   // an interface that is made anew gets another
  std::string address;  // "10.0.0.7"; empty: none
  bool up = false;
  bool connected = false;  // a cable or a radio leads somewhere
  bool loopback = false;
  bool multicast = false;
  bool hardware = false;  // not a bridge of containers, a tunnel or the like
  bool ipv6 = false;      // has an IPv6 address that other machines reach

  // Whether who joined by the one is still there with the other.
  [[nodiscard]] bool operator==(const Interface& other) const {
    return name == other.name && index == other.index && address == other.address;
  }
};

// In the kernel's order, which is Cyclone's. Empty if the kernel does not say.
[[nodiscard]] std::vector<Interface> Interfaces();

// "eth0 (10.0.0.7), lo (127.0.0.1)".
[[nodiscard]] std::string ToText(const std::vector<Interface>& interfaces);

}  // namespace trailcast::dds
