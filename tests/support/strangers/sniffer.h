#pragma once

#include <arpa/inet.h>
#include <linux/if_ether.h>
#include <linux/if_packet.h>
#include <net/if.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <stdexcept>
#include <string>
#include <thread>

namespace trailcast::test {

// This reads whatever passes an interface, as anyone at the same switch could. It needs root.
class Sniffer {
 public:
  explicit Sniffer(const std::string& interface) : socket_(Open()) {
    sockaddr_ll address{};
    address.sll_family = AF_PACKET;
    address.sll_protocol = htons(ETH_P_ALL);
    address.sll_ifindex = static_cast<int>(if_nametoindex(interface.c_str()));
    const timeval patience{.tv_sec = 0, .tv_usec = 100'000};
    const int buffer = 64 << 20;
    if (socket_ < 0 || bind(socket_, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0 ||
        setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience) != 0) {
      throw std::runtime_error("cannot listen on " + interface);
    }
    setsockopt(socket_, SOL_SOCKET, SO_RCVBUFFORCE, &buffer, sizeof buffer);
    thread_ = std::thread([this] { Listen(); });
  }
  Sniffer(const Sniffer&) = delete;
  Sniffer& operator=(const Sniffer&) = delete;
  ~Sniffer() {
    if (thread_.joinable()) (void)Stop();
    close(socket_);
  }

  // Returns all frames since the beginning, one after the other.
  [[nodiscard]] std::string Stop() {
    stop_ = true;
    thread_.join();
    return std::move(heard_);
  }

 private:
  static int Open() { return socket(AF_PACKET, SOCK_RAW | SOCK_CLOEXEC, htons(ETH_P_ALL)); }

  void Listen() {
    std::array<char, 70'000> frame{};
    while (!stop_) {
      const ssize_t size = recv(socket_, frame.data(), frame.size(), 0);
      if (size > 0) heard_.append(frame.data(), static_cast<std::size_t>(size));
    }
  }

  int socket_;
  std::atomic<bool> stop_ = false;
  std::string heard_;
  std::thread thread_;
};

}  // namespace trailcast::test
