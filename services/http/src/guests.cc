#include "services/http/src/guests.h"

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

std::size_t ConnectionsOf(const Guests::Guest& guest) { return guest.address->second.all(); }

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
}

void Guests::Take(int socket, const std::string& address) {
  std::unique_lock lock(mutex_);
  const auto from = addresses_.try_emplace(address).first;
  const bool strangers = limits_.of_one_address > 0;
  if (strangers && from->second.all() >= limits_.of_one_address) return HangUp(socket);
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

void Guests::LetStay(Guest& guest) {
  const std::scoped_lock lock(mutex_);
  guest.stays = true;
}

void Guests::MakeRoom() {
  const std::scoped_lock lock(mutex_);
  while (Lacks(limits_.threads) && SendAway(waiting_.front().address->second.all())) continue;
}

// Whether so many places are too few for all who are there, and those who come.
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
    guest->began = steady_clock::now();
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

// One, for a newcomer whose address has so many; false: nobody may be.
bool Guests::SendAway(std::size_t newcomers) {
  Guest* most = nullptr;
  for (Guest& guest : answered_) {
    if (guest.stays || guest.leaves) continue;
    if (most == nullptr || ConnectionsOf(guest) > ConnectionsOf(*most)) most = &guest;
  }
  if (most == nullptr) return false;
  const bool in_time = steady_clock::now() < most->began + kPolite;
  if (in_time && ConnectionsOf(*most) <= newcomers) return false;
  most->leaves = true;
  ++leaving_;
  (void)shutdown(most->socket, SHUT_RDWR);
  return true;
}

// The same of those who have no thread yet.
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
  HangUp(guest->socket);
  if (ConnectionsOf(*guest) == 0) addresses_.erase(guest->address);
  list.erase(guest);
}

}  // namespace trailcast::http
