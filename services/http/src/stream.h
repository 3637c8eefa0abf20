#pragma once

#include <httplib.h>
#include <poll.h>

#include <array>
#include <chrono>
#include <string>

namespace trailcast::server {

// One request of a client that may be anybody: no more of it is read than kMostBytes, for no longer
// than kPatience, whatever it says of its length. The socket is the caller's to close.
class HttpStream final : public httplib::Stream {
 public:
  static constexpr std::size_t kMostBytes = 64U << 10U;
  static constexpr std::chrono::milliseconds kPatience{5000};

  explicit HttpStream(socket_t socket) : socket_(socket) {}

  [[nodiscard]] bool is_readable() const override { return WaitFor(POLLIN); }
  [[nodiscard]] bool is_writable() const override { return WaitFor(POLLOUT); }
  ssize_t read(char* to, std::size_t size) override;
  ssize_t write(const char* from, std::size_t size) override;
  void get_remote_ip_and_port(std::string&, int&) const override {}
  void get_local_ip_and_port(std::string&, int&) const override {}
  [[nodiscard]] socket_t socket() const override { return socket_; }

 private:
  [[nodiscard]] bool WaitFor(short event) const;

  socket_t socket_;
  const std::chrono::steady_clock::time_point until_ = std::chrono::steady_clock::now() + kPatience;
  std::array<char, 4096> buffer_{};  // what came and was not read yet: [next_, end_)
  std::size_t next_ = 0;
  std::size_t end_ = 0;
  std::size_t came_ = 0;
};

// Answers one request a connection.
class HttpServer final : public httplib::Server {
 private:
  bool process_and_close_socket(socket_t socket) override;
};

}  // namespace trailcast::server
