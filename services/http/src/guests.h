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

// Holds connections and the threads that answer them. Clients that flood it and say nothing, speak
// slowly or do not take their answers cost others almost nothing. If no thread is free, one is
// taken from an awaited guest of the address with most connections. Among the guests that wait for
// a thread, the address with the fewest is next.
class Guests {
 public:
  struct Address {
    std::size_t answered = 0;  // connections with a thread
    std::size_t waiting = 0;
    [[nodiscard]] std::size_t all() const { return answered + waiting; }
  };
  using Addresses = std::map<std::string, Address>;
  struct Guest {
    int socket = -1;
    Addresses::iterator address{};
    // Since when the guest's thread waits for it, to send its request or to take its answer.
    std::optional<std::chrono::steady_clock::time_point> awaited_since{};
    bool leaves = false;  // it was sent away
  };
  // A guest that is awaited for longer may be sent away even if its address has no more connections
  // than others.
  static constexpr std::chrono::milliseconds kPolite{1000};
  // An answered guest has so long to take what the kernel still has for it.
  static constexpr std::chrono::milliseconds kFarewell{20'000};

  // `answer` is called with each guest and returns once it is answered.
  Guests(const Limits& limits, std::function<void(Guest&)> answer);
  ~Guests();
  Guests(const Guests&) = delete;
  Guests& operator=(const Guests&) = delete;

  // Takes a connection. Its socket is closed once the client has taken the answer or there is no
  // room for it: the kernel keeps answers for as many as may be connected, and no more. Take waits
  // for room, except where strangers come (Limits::of_one_address).
  void Take(int socket, const std::string& address);
  // Notes, from the guest's thread, whether that waits for it now.
  void Await(Guest& guest, bool awaited);
  // Closes what can be closed; the owner calls it now and then.
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
  std::mutex mutex_;  // guards everything below
  Addresses addresses_;
  std::list<Guest> waiting_;
  std::list<Guest> answered_;      // the oldest first
  std::size_t leaving_ = 0;        // how many of them were sent away
  std::list<Farewell> farewells_;  // the oldest first
  bool over_ = false;
  std::condition_variable comes_;
  std::condition_variable goes_;
  std::vector<std::thread> threads_;
};

}  // namespace trailcast::http
