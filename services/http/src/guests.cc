#include "services/http/src/guests.h"

#include <linux/sockios.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <utility>

namespace trailcast::http {
namespace {

using std::chrono::steady_clock;

void HangUp(int socket) {
  (void)shutdown(socket, SHUT_RDWR);
  (void)close(socket);
}

bool HasTakenAll(int socket) {
  int bytes = 0;
  return ioctl(socket, SIOCOUTQ, &bytes) != 0 || bytes == 0;
}

// Makes closing discard what was not sent.
void ForgetTheRest(int socket) {
  constexpr linger kAtOnce{.l_onoff = 1, .l_linger = 0};
  (void)setsockopt(socket, SOL_SOCKET, SO_LINGER, &kAtOnce, sizeof(kAtOnce));
}

std::size_t ConnectionsOf(const Guests::Guest& guest) { return guest.address->second.all(); }

// Orders guests for being sent away: first those whose address has more connections, then those
// that were awaited for longer.
bool IsBefore(const Guests::Guest& one, const Guests::Guest& other) {
  const std::size_t ones = ConnectionsOf(one);
  const std::size_t others = ConnectionsOf(other);
  return ones != others ? ones > others : one.awaited_since < other.awaited_since;
}

bool InTime(const Guests::Guest& guest) {
  return steady_clock::now() < *guest.awaited_since + Guests::kPolite;
}

}  // namespace

Guests::Guests(const Limits& limits, std::function<void(Guest&)> answer)
    : limits_(limits), answer_(std::move(answer)) {
  threads_.reserve(limits_.threads);
  for (std::size_t i = 0; i < limits_.threads; ++i) threads_.emplace_back([this] { Work(); });
}

Guests::~Guests() {
  {
    const std::scoped_lock lock(mutex_);
    over_ = true;
  }
  comes_.notify_all();
  for (std::thread& thread : threads_) thread.join();
  for (const Guest& guest : waiting_) HangUp(guest.socket);
  for (const Farewell& farewell : farewells_) (void)close(farewell.socket);
}

void Guests::Take(int socket, const std::string& address) {
  std::unique_lock lock(mutex_);
  const auto from = addresses_.try_emplace(address).first;
  const bool strangers = limits_.of_one_address > 0;
  const bool is_full = strangers && from->second.all() >= limits_.of_one_address;
  if (is_full && !SendAwayOf(from)) return HangUp(socket);
  ++from->second.waiting;
  const auto is_room = [&] {
    const std::size_t own = from->second.all();
    return !Lacks(limits_.threads + limits_.waiting, 1) || HangUpOnWaiting(own) || SendAway(own);
  };
  while (!is_room()) {
    if (strangers) {
      --from->second.waiting;
      if (from->second.all() == 0) addresses_.erase(from);
      return HangUp(socket);
    }
    goes_.wait_for(lock, kPolite);
  }
  waiting_.push_back({.socket = socket, .address = from});
  if (Lacks(limits_.threads)) (void)SendAway(from->second.all());
  comes_.notify_one();
}

void Guests::Await(Guest& guest, bool awaited) {
  const std::scoped_lock lock(mutex_);
  guest.awaited_since.reset();
  if (awaited) guest.awaited_since = steady_clock::now();
}

void Guests::MakeRoom() {
  const std::scoped_lock lock(mutex_);
  while (Lacks(limits_.threads) && SendAway(waiting_.front().address->second.all())) continue;
  SeeOff();
}

// Says whether so many places are too few for the present and the arriving guests.
bool Guests::Lacks(std::size_t places, std::size_t come) const {
  return waiting_.size() + answered_.size() + come > places + leaving_;
}

void Guests::Work() {
  std::unique_lock lock(mutex_);
  while (true) {
    comes_.wait(lock, [this] { return over_ || !waiting_.empty(); });
    if (over_) return;
    const auto guest = std::min_element(
        waiting_.begin(), waiting_.end(), [](const Guest& one, const Guest& other) {
          return one.address->second.answered < other.address->second.answered;
        });
    --guest->address->second.waiting;
    ++guest->address->second.answered;
    guest->awaited_since = steady_clock::now();
    answered_.splice(answered_.end(), waiting_, guest);
    lock.unlock();
    answer_(*guest);
    lock.lock();
    --guest->address->second.answered;
    if (guest->leaves) --leaving_;
    Leave(answered_, guest);
    goes_.notify_one();
  }
}

// Sends one guest away for a newcomer whose address has so many; returns false if nobody may be
// sent away.
bool Guests::SendAway(std::size_t newcomers) {
  Guest* most = nullptr;
  for (Guest& guest : answered_) {
    if (!guest.awaited_since || guest.leaves) continue;
    if (most == nullptr || IsBefore(guest, *most)) most = &guest;
  }
  if (most == nullptr) return false;
  if (InTime(*most) && ConnectionsOf(*most) <= newcomers) return false;
  Dismiss(*most);
  return true;
}

// Sends one guest away for a newcomer of the same address.
bool Guests::SendAwayOf(Addresses::const_iterator address) {
  const auto late = std::find_if(answered_.begin(), answered_.end(), [&](const Guest& guest) {
    return guest.address == address && guest.awaited_since && !guest.leaves && !InTime(guest);
  });
  if (late == answered_.end()) return false;
  Dismiss(*late);
  return true;
}

void Guests::Dismiss(Guest& guest) {
  guest.leaves = true;
  ++leaving_;
  (void)shutdown(guest.socket, SHUT_RDWR);
}

// Does the same among guests that have no thread yet.
bool Guests::HangUpOnWaiting(std::size_t newcomers) {
  const auto most =
      std::max_element(waiting_.begin(), waiting_.end(), [](const Guest& one, const Guest& other) {
        return ConnectionsOf(one) < ConnectionsOf(other);
      });
  if (most == waiting_.end() || ConnectionsOf(*most) <= newcomers) return false;
  --most->address->second.waiting;
  Leave(waiting_, most);
  return true;
}

void Guests::Leave(std::list<Guest>& list, std::list<Guest>::iterator guest) {
  (void)shutdown(guest->socket, SHUT_RDWR);
  farewells_.push_back({.socket = guest->socket,
                        .address = guest->address->first,
                        .until = steady_clock::now() + kFarewell});
  if (ConnectionsOf(*guest) == 0) addresses_.erase(guest->address);
  list.erase(guest);
  SeeOff();
}

// Closes connections that have taken everything, those that take too long, and the oldest ones if
// there are too many.
void Guests::SeeOff() {
  std::map<std::string, std::size_t> of;
  farewells_.remove_if([&](const Farewell& farewell) {
    const bool is_over = HasTakenAll(farewell.socket);
    const bool is_late = !is_over && steady_clock::now() >= farewell.until;
    if (!is_over && !is_late) {
      ++of[farewell.address];
      return false;
    }
    if (is_late) ForgetTheRest(farewell.socket);
    (void)close(farewell.socket);
    return true;
  });
  const auto fewer = [](const auto& one, const auto& other) { return one.second < other.second; };
  while (!farewells_.empty()) {
    const auto most = std::max_element(of.begin(), of.end(), fewer);
    const bool too_many_of_one =
        limits_.of_one_address > 0 && most->second > limits_.of_one_address;
    if (!too_many_of_one && farewells_.size() <= limits_.threads + limits_.waiting) return;
    const auto eldest =
        std::find_if(farewells_.begin(), farewells_.end(),
                     [&](const Farewell& farewell) { return farewell.address == most->first; });
    ForgetTheRest(eldest->socket);
    (void)close(eldest->socket);
    farewells_.erase(eldest);
    --most->second;
  }
}

}  // namespace trailcast::http
