#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <functional>
#include <list>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "services/http/server.h"

namespace trailcast::http {

// Connections, and the threads that answer them. A flood of clients that say nothing, or say it
// slowly, costs others next to nothing: while no thread is free, one is taken from who has not said
// yet what they want, of the address that has most connections; and of those who wait for a thread
// the one is next whose address has the fewest.
class Guests {
 public:
  struct Address {
    std::size_t answered = 0;  // connections that a thread has
    std::size_t waiting = 0;
    [[nodiscard]] std::size_t all() const { return answered + waiting; }
  };
  using Addresses = std::map<std::string, Address>;
  struct Guest {
    int socket = -1;
    Addresses::iterator address{};
    std::chrono::steady_clock::time_point began{};  // to be answered
    bool stays = false;                             // it has said what it wants
    bool leaves = false;                            // it was sent away
  };
  // Who is not quicker than this may be sent away although its address has no more than others.
  static constexpr std::chrono::milliseconds kPolite{1000};

  // `answer`: with a guest, until it is answered.
  Guests(const Limits& limits, std::function<void(Guest&)> answer);
  ~Guests();
  Guests(const Guests&) = delete;
  Guests& operator=(const Guests&) = delete;

  // The socket is closed when it is answered, or there is no room for it. Waits until there is; but
  // not where strangers come (Limits::of_one_address).
  void Take(int socket, const std::string& address);
  // It has said what it wants.
  void LetStay(Guest& guest);
  // To be called now and then.
  void MakeRoom();

 private:
  void Work();
  [[nodiscard]] bool Lacks(std::size_t places, std::size_t come = 0) const;
  bool SendAway(std::size_t newcomers);
  bool HangUpOnWaiting(std::size_t newcomers);
  void Leave(std::list<Guest>& list, std::list<Guest>::iterator guest);

  const Limits limits_;
  const std::function<void(Guest&)> answer_;
  std::mutex mutex_;  // guards what follows
  Addresses addresses_;
  std::list<Guest> waiting_;
  std::list<Guest> answered_;  // the oldest first
  std::size_t leaving_ = 0;    // of them, sent away
  bool over_ = false;
  std::condition_variable comes_;
  std::condition_variable goes_;
  std::vector<std::thread> threads_;
};

}  // namespace trailcast::http
