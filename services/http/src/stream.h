#pragma once

#include <httplib.h>
#include <poll.h>

#include <array>
#include <chrono>
#include <functional>
#include <string>
#include <utility>

namespace trailcast::http {

// Carries one request of a client that may be anybody. It reads at most kMostBytes for at most
// kPatience, whatever length the request announces, and waits at most kWritePatience in all for the
// client to take its answer, unless more is allowed. It reads the method in upper case, because
// cpp-httplib refuses others. The caller closes the socket.
class Stream : public httplib::Stream {
 public:
  // Room for a request: its body and as much again.
  static constexpr std::size_t kMostBytes = 128U << 10U;
  static constexpr std::chrono::milliseconds kPatience{5'000};
  static constexpr std::chrono::milliseconds kWritePatience{20'000};

  static constexpr std::chrono::milliseconds kLongestPause{10'000};

  // Called when the client begins or ceases to be awaited. It is awaited at first, until it has
  // sent its request, and again while it does not take its answer.
  using TellAwaited = std::function<void(bool)>;

  explicit Stream(socket_t socket, TellAwaited tell = {})
      : socket_(socket), tell_(std::move(tell)) {}

  // Allows so many more bytes, and so long from now on, without a pause of kLongestPause.
  void Allow(std::size_t bytes, std::chrono::milliseconds patience);
  // Regards the request as complete once so many more bytes were read.
  void AwaitBody(std::size_t bytes);
  // Ends reading at so long from now.
  void Hurry(std::chrono::milliseconds patience);

  [[nodiscard]] bool is_readable() const override;
  // It is not writable either once the client has hung up.
  [[nodiscard]] bool is_writable() const override;
  ssize_t read(char* to, std::size_t size) final;
  ssize_t write(const char* from, std::size_t size) final;
  void get_remote_ip_and_port(std::string& ip, int& port) const override;
  void get_local_ip_and_port(std::string&, int&) const override {}
  [[nodiscard]] socket_t socket() const override { return socket_; }

 protected:
  // They act as recv and send do, and wait by the functions below, which return false when patience
  // is over.
  virtual ssize_t Get(char* to, std::size_t size);
  virtual ssize_t Put(const char* from, std::size_t size);
  [[nodiscard]] bool WaitToRead(short events) const;
  [[nodiscard]] bool WaitToWrite(short events);

 private:
  using Clock = std::chrono::steady_clock;

  // Returns which of these events came about; the end of the connection counts as one.
  short WaitToTake(short events) const;

  socket_t socket_;
  TellAwaited tell_;
  bool has_asked_ = false;
  std::size_t awaited_bytes_ = 0;  // the part of the body that is still missing
  std::size_t most_bytes_ = kMostBytes;
  Clock::time_point read_until_ = Clock::now() + kPatience;
  Clock::duration write_wait_left_ = kWritePatience;
  Clock::duration longest_pause_ = kWritePatience;
  std::array<char, 4096> buffer_{};  // bytes that came and were not read yet: [next_, end_)
  std::size_t next_ = 0;
  std::size_t end_ = 0;
  std::size_t came_ = 0;
  bool in_method_ = true;  // the request's first word was not read to its end
};

}  // namespace trailcast::http
