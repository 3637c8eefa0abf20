#include "services/http/src/stream.h"

#include <sys/socket.h>

#include <algorithm>

namespace trailcast::http {
namespace {

using std::chrono::milliseconds;

// What of these has come about within `most`.
short WaitFor(socket_t socket, short events, std::chrono::steady_clock::duration most) {
  const auto left = std::chrono::duration_cast<milliseconds>(most);
  pollfd waited{.fd = socket, .events = events, .revents = 0};
  const bool any = left > milliseconds{0} && poll(&waited, 1, static_cast<int>(left.count())) > 0;
  return any ? waited.revents : short{0};
}

}  // namespace

bool Stream::is_readable() const {
  return WaitFor(socket_, POLLIN, read_until_ - Clock::now()) != 0;
}

bool Stream::is_writable() const {
  constexpr short kHungUp = POLLRDHUP | POLLHUP | POLLERR;
  const short seen = WaitFor(socket_, POLLOUT | POLLRDHUP, write_wait_left_);
  return (seen & POLLOUT) != 0 && (seen & kHungUp) == 0;
}

ssize_t Stream::read(char* to, std::size_t size) {
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

ssize_t Stream::write(const char* from, std::size_t size) {
  const auto began = Clock::now();
  const bool takes = (WaitFor(socket_, POLLOUT, write_wait_left_) & POLLOUT) != 0;
  write_wait_left_ -= Clock::now() - began;
  // As much as there is room for, so that no send waits longer.
  return takes ? send(socket_, from, size, MSG_NOSIGNAL | MSG_DONTWAIT) : -1;
}

}  // namespace trailcast::http
