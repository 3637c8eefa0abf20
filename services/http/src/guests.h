#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <functional>
#include <list>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "services/http/server.h"

namespace trailcast::http {

// Connections, and the threads that answer them. A flood of clients that say nothing, say it slowly
// or do not take their answers costs others next to nothing: while no thread is free, one is taken
// from who is awaited, of the address that has most connections; and of those who wait for a thread
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
    // Since when its thread waits for it: to say what it wants, or to take its answer.
    std::optional<std::chrono::steady_clock::time_point> awaited_since{};
    bool leaves = false;  // it was sent away
  };
  // Who is awaited for longer may be sent away although its address has no more than others.
  static constexpr std::chrono::milliseconds kPolite{1000};
  // Who was answered may take what the kernel still has of it for so long.
  static constexpr std::chrono::milliseconds kFarewell{20'000};

  // `answer`: with a guest, until it is answered.
  Guests(const Limits& limits, std::function<void(Guest&)> answer);
  ~Guests();
  Guests(const Guests&) = delete;
  Guests& operator=(const Guests&) = delete;

  // The socket is closed when its client has taken the answer, or there is no room for it: of as
  // many as may be connected the kernel keeps answers, and no more. Waits until there is; but not
  // where strangers come (Limits::of_one_address).
  void Take(int socket, const std::string& address);
  // From its thread: whether that waits for it now.
  void Await(Guest& guest, bool awaited);
  // To be called now and then.
  void MakeRoom();

 private:
  struct Farewell {
    int socket = -1;
    std::string address{};
    std::chrono::steady_clock::time_point until{};
  };

  void Work();
  [[nodiscard]] bool Lacks(std::size_t places, std::size_t come = 0) const;
  bool SendAway(std::size_t newcomers);
  bool SendAwayOf(Addresses::const_iterator address);
  void Dismiss(Guest& guest);
  bool HangUpOnWaiting(std::size_t newcomers);
  void Leave(std::list<Guest>& list, std::list<Guest>::iterator guest);
  void SeeOff();

  const Limits limits_;
  const std::function<void(Guest&)> answer_;
  std::mutex mutex_;  // guards what follows
  Addresses addresses_;
  std::list<Guest> waiting_;
  std::list<Guest> answered_;      // the oldest first
  std::size_t leaving_ = 0;        // of them, sent away
  std::list<Farewell> farewells_;  // the oldest first
  bool over_ = false;
  std::condition_variable comes_;
  std::condition_variable goes_;
  std::vector<std::thread> threads_;
};

}  // namespace trailcast::http
