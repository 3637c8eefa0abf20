#pragma once

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cstddef>
#include <fstream>
#include <string>

namespace trailcast::test {

// This is a connection to a port of this machine that no HTTP library would make.
class RawConnection {
 public:
  // `from` is one of this machine's addresses.
  explicit RawConnection(int port, const std::string& from = "127.0.0.1")
      : socket_(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    sockaddr_in own{};
    own.sin_family = AF_INET;
    EXPECT_EQ(inet_pton(AF_INET, from.c_str(), &own.sin_addr), 1);
    EXPECT_EQ(bind(socket_, reinterpret_cast<sockaddr*>(&own), sizeof(own)), 0);
    constexpr timeval kBound{.tv_sec = 20, .tv_usec = 0};
    setsockopt(socket_, SOL_SOCKET, SO_SNDTIMEO, &kBound, sizeof(kBound));
    setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &kBound, sizeof(kBound));
    EXPECT_EQ(connect(socket_, reinterpret_cast<sockaddr*>(&address), sizeof(address)), 0);
  }
  ~RawConnection() { close(socket_); }
  RawConnection(const RawConnection&) = delete;
  RawConnection& operator=(const RawConnection&) = delete;

  // Returns how many of the bytes were taken.
  std::size_t Send(const std::string& text) const {
    const ssize_t sent = send(socket_, text.data(), text.size(), MSG_NOSIGNAL);
    return sent > 0 ? static_cast<std::size_t>(sent) : 0;
  }
  // Sends `beginning`, and `more` repeatedly until the other side has had enough. Returns how many
  // bytes it took.
  std::size_t SendForEver(const std::string& beginning, const std::string& more) const {
    constexpr std::size_t kTooMuch = 200U << 20U;
    std::size_t taken = Send(beginning);
    while (taken < kTooMuch) {
      const std::size_t sent = Send(more);
      if (sent == 0) break;
      taken += sent;
    }
    return taken;
  }
  [[nodiscard]] std::string Receive() const {
    std::array<char, 4096> bytes{};
    const ssize_t got = recv(socket_, bytes.data(), bytes.size(), 0);
    return got > 0 ? std::string(bytes.data(), static_cast<std::size_t>(got)) : "";
  }
  // Waits until the other side hangs up.
  [[nodiscard]] std::string ReceiveAll() const {
    std::string all;
    while (true) {
      const std::string more = Receive();
      if (more.empty()) return all;
      all += more;
    }
  }

 private:
  int socket_;
};

// Returns the resident memory of this process.
inline std::size_t ResidentBytes() {
  std::ifstream statm("/proc/self/statm");
  std::size_t pages = 0;
  statm >> pages >> pages;
  return pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

}  // namespace trailcast::test
