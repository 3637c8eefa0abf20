#pragma once

#include <httplib.h>
#include <poll.h>

#include <array>
#include <chrono>
#include <functional>
#include <string>
#include <utility>

namespace trailcast::http {

// One request of a client that may be anybody: no more of it is read than kMostBytes, for no longer
// than kPatience, whatever it says of its length; and no longer than kWritePatience in all is
// waited for a client to take its answer, unless more is allowed. The socket is the caller's to
// close.
class Stream : public httplib::Stream {
 public:
  // Of a request: its body and as much again.
  static constexpr std::size_t kMostBytes = 128U << 10U;
  static constexpr std::chrono::milliseconds kPatience{5'000};
  static constexpr std::chrono::milliseconds kWritePatience{20'000};

  static constexpr std::chrono::milliseconds kLongestPause{10'000};

  // Whether the client is awaited, as it is to begin with: no more when it has said what it wants,
  // and while it does not take its answer.
  using TellAwaited = std::function<void(bool)>;

  explicit Stream(socket_t socket, TellAwaited tell = {})
      : socket_(socket), tell_(std::move(tell)) {}

  // So many bytes more, and so long from now on, but no pause of kLongestPause.
  void Allow(std::size_t bytes, std::chrono::milliseconds patience);
  // It has said what it wants when so many bytes more were read.
  void AwaitBody(std::size_t bytes);
  // Nothing is read later than so long from now.
  void Hurry(std::chrono::milliseconds patience);

  [[nodiscard]] bool is_readable() const override;
  // Nor once the client has hung up.
  [[nodiscard]] bool is_writable() const override;
  ssize_t read(char* to, std::size_t size) final;
  ssize_t write(const char* from, std::size_t size) final;
  void get_remote_ip_and_port(std::string& ip, int& port) const override;
  void get_local_ip_and_port(std::string&, int&) const override {}
  [[nodiscard]] socket_t socket() const override { return socket_; }

 protected:
  // As recv and send; they wait by these, which are false when patience is over.
  virtual ssize_t Get(char* to, std::size_t size);
  virtual ssize_t Put(const char* from, std::size_t size);
  [[nodiscard]] bool WaitToRead(short events) const;
  [[nodiscard]] bool WaitToWrite(short events);

 private:
  using Clock = std::chrono::steady_clock;

  // What of these has come about, or that the connection has ended.
  short WaitToTake(short events) const;

  socket_t socket_;
  TellAwaited tell_;
  bool has_asked_ = false;
  std::size_t awaited_bytes_ = 0;  // of its body
  std::size_t most_bytes_ = kMostBytes;
  Clock::time_point read_until_ = Clock::now() + kPatience;
  Clock::duration write_wait_left_ = kWritePatience;
  Clock::duration longest_pause_ = kWritePatience;
  std::array<char, 4096> buffer_{};  // what came and was not read yet: [next_, end_)
  std::size_t next_ = 0;
  std::size_t end_ = 0;
  std::size_t came_ = 0;
};

}  // namespace trailcast::http
