#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <thread>

namespace trailcast::store {

// Breaks a connection whose other end has been silent for too long, for a library that would wait
// for ever. The thread that waits on the socket then learns that it is closed. It has a thread.
class SilenceWatch {
 public:
  explicit SilenceWatch(std::chrono::milliseconds patience);
  ~SilenceWatch();
  SilenceWatch(const SilenceWatch&) = delete;
  SilenceWatch& operator=(const SilenceWatch&) = delete;

  // Waits for an answer on `socket` during its lifetime. There is one at a time.
  class Guard {
   public:
    Guard(SilenceWatch& watch, int socket);
    ~Guard();
    Guard(const Guard&) = delete;
    Guard& operator=(const Guard&) = delete;

   private:
    SilenceWatch& watch_;
  };

 private:
  struct Watched {
    int socket;
    std::chrono::steady_clock::time_point until;
  };
  void Run();

  std::chrono::milliseconds patience_;
  std::mutex mutex_;  // guards everything below
  std::condition_variable changed_;
  std::optional<Watched> watched_;
  bool over_ = false;
  std::thread thread_;
};

}  // namespace trailcast::store
