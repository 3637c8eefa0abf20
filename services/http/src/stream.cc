#include "services/http/src/stream.h"

#include <netdb.h>
#include <sys/socket.h>

#include <algorithm>
#include <cctype>

#include "services/base/number.h"

namespace trailcast::http {
namespace {

using std::chrono::milliseconds;

// Returns which of these events come about within `most`.
short WaitFor(socket_t socket, short events, std::chrono::steady_clock::duration most) {
  const auto left = std::chrono::duration_cast<milliseconds>(most);
  pollfd waited{.fd = socket, .events = events, .revents = 0};
  const bool any = left >= milliseconds{0} && poll(&waited, 1, static_cast<int>(left.count())) > 0;
  return any ? waited.revents : short{0};
}

}  // namespace

void Stream::Allow(std::size_t bytes, milliseconds patience) {
  most_bytes_ = kMostBytes + bytes;
  read_until_ = Clock::now() + patience;
  write_wait_left_ = patience;
  longest_pause_ = kLongestPause;
}

void Stream::AwaitBody(std::size_t bytes) {
  awaited_bytes_ = bytes;
  has_asked_ = bytes == 0;
  if (has_asked_ && tell_) tell_(false);
}

void Stream::Hurry(milliseconds patience) {
  read_until_ = std::min(read_until_, Clock::now() + patience);
}

bool Stream::is_readable() const { return WaitToRead(POLLIN); }

bool Stream::is_writable() const {
  constexpr short kHungUp = POLLRDHUP | POLLHUP | POLLERR;
  const short seen = WaitToTake(POLLOUT | POLLRDHUP);
  return (seen & POLLOUT) != 0 && (seen & kHungUp) == 0;
}

ssize_t Stream::read(char* to, std::size_t size) {
  if (next_ == end_) {
    const std::size_t most = std::min(buffer_.size(), most_bytes_ - came_);
    if (most == 0) return -1;
    const ssize_t got = Get(buffer_.data(), most);
    if (got <= 0) return got;
    next_ = 0;
    end_ = static_cast<std::size_t>(got);
    came_ += end_;
  }
  const std::size_t given = std::min(size, end_ - next_);
  std::copy_n(buffer_.begin() + static_cast<std::ptrdiff_t>(next_), given, to);
  next_ += given;
  for (std::size_t i = 0; i < given && in_method_; ++i) {
    in_method_ = to[i] != ' ';
    to[i] = static_cast<char>(std::toupper(static_cast<unsigned char>(to[i])));
  }
  if (awaited_bytes_ > 0 && given > 0) AwaitBody(awaited_bytes_ - std::min(awaited_bytes_, given));
  return static_cast<ssize_t>(given);
}

ssize_t Stream::write(const char* from, std::size_t size) { return Put(from, size); }

void Stream::get_remote_ip_and_port(std::string& ip, int& port) const {
  sockaddr_storage address{};
  socklen_t size = sizeof(address);
  auto* const peer = reinterpret_cast<sockaddr*>(&address);
  std::array<char, NI_MAXHOST> host{};
  std::array<char, NI_MAXSERV> service{};
  if (getpeername(socket_, peer, &size) != 0 ||
      getnameinfo(peer, size, host.data(), host.size(), service.data(), service.size(),
                  NI_NUMERICHOST | NI_NUMERICSERV) != 0) {
    return;
  }
  ip = host.data();
  (void)ReadNumber(service.data(), port);
}

ssize_t Stream::Get(char* to, std::size_t size) {
  return WaitToRead(POLLIN) ? recv(socket_, to, size, 0) : -1;
}

ssize_t Stream::Put(const char* from, std::size_t size) {
  // It sends as much as there is room for, so that no send waits longer.
  return WaitToWrite(POLLOUT) ? send(socket_, from, size, MSG_NOSIGNAL | MSG_DONTWAIT) : -1;
}

bool Stream::WaitToRead(short events) const {
  return WaitFor(socket_, events, std::min(read_until_ - Clock::now(), longest_pause_)) != 0;
}

bool Stream::WaitToWrite(short events) {
  const auto began = Clock::now();
  const bool takes = (WaitToTake(events) & events) != 0;
  write_wait_left_ -= Clock::now() - began;
  return takes;
}

short Stream::WaitToTake(short events) const {
  if (const short seen = WaitFor(socket_, events, milliseconds{0}); seen != 0) return seen;
  const bool tell = has_asked_ && tell_;
  if (tell) tell_(true);
  const short seen = WaitFor(socket_, events, std::min(write_wait_left_, longest_pause_));
  if (tell) tell_(false);
  return seen;
}

}  // namespace trailcast::http
