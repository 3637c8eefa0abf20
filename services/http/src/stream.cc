#include "route_server/http_stream.h"

#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>

namespace trailcast::server {

bool HttpStream::WaitFor(short event) const {
  using std::chrono::milliseconds;
  const auto left =
      std::chrono::duration_cast<milliseconds>(until_ - std::chrono::steady_clock::now());
  pollfd waited{.fd = socket_, .events = event, .revents = 0};
  return left > milliseconds{0} && poll(&waited, 1, static_cast<int>(left.count())) > 0;
}

ssize_t HttpStream::read(char* to, std::size_t size) {
  if (next_ == end_) {
    const std::size_t most = std::min(buffer_.size(), kMostBytes - came_);
    if (most == 0 || !is_readable()) return -1;
    const ssize_t got = recv(socket_, buffer_.data(), most, 0);
    if (got <= 0) return got;
    next_ = 0;
    end_ = static_cast<std::size_t>(got);
    came_ += end_;
  }
  const std::size_t given = std::min(size, end_ - next_);
  std::copy_n(buffer_.begin() + static_cast<std::ptrdiff_t>(next_), given, to);
  next_ += given;
  return static_cast<ssize_t>(given);
}

ssize_t HttpStream::write(const char* from, std::size_t size) {
  return is_writable() ? send(socket_, from, size, MSG_NOSIGNAL) : -1;
}

bool HttpServer::process_and_close_socket(socket_t socket) {
  HttpStream stream(socket);
  bool closed = false;
  const bool answered = process_request(stream, /*close_connection=*/true, closed, nullptr);
  (void)shutdown(socket, SHUT_RDWR);
  (void)close(socket);
  return answered;
}

}  // namespace trailcast::server
