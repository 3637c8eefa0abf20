#pragma once

#include <string>
#include <vector>

namespace trailcast::dds {

// A network interface of this machine, with one of its IPv4 addresses if it has any.
struct Interface {
  std::string name;
  unsigned index = 0;   // an interface that is made again gets another one
  std::string address;  // "10.0.0.7"; empty if there is none
  bool up = false;
  bool connected = false;  // a cable or a radio has a link
  bool loopback = false;
  bool multicast = false;
  bool hardware = false;  // no bridge of containers, tunnel or the like
  bool ipv6 = false;      // has an IPv6 address that other machines can reach

  // Equal interfaces can replace each other without joining again.
  [[nodiscard]] bool operator==(const Interface& other) const {
    return name == other.name && index == other.index && address == other.address;
  }
};

// Returns them in the kernel's order, which is Cyclone's, or nothing if the kernel does not tell.
[[nodiscard]] std::vector<Interface> Interfaces();

// Returns "eth0 (10.0.0.7), lo (127.0.0.1)".
[[nodiscard]] std::string ToText(const std::vector<Interface>& interfaces);

}  // namespace trailcast::dds
