#include "services/users/throttle.h"

#include <algorithm>

#include "services/users/secret.h"

namespace trailcast::users {

using std::chrono::milliseconds;

Throttle::Throttle(const Pace& pace) : pace_(pace), secret_(DrawToken()) {}

milliseconds Throttle::Wait(std::string_view key, Time now) const {
  const Place& place = places_[PlaceOf(key)];
  return std::max(milliseconds{0}, std::chrono::ceil<milliseconds>(place.until - now));
}

void Throttle::Fail(std::string_view key, Time now) {
  Place& place = places_[PlaceOf(key)];
  if (now >= place.last + pace_.forgets) place.failed = 0;
  place.last = now;
  ++place.failed;
  if (place.failed <= pace_.free) return;
  constexpr int kMostDoublings = 20;
  const int doublings = std::min(place.failed - pace_.free - 1, kMostDoublings);
  place.until = now + std::min(pace_.longest, pace_.first * (1 << doublings));
}

void Throttle::Forgive(std::string_view key) { places_[PlaceOf(key)] = {}; }

std::size_t Throttle::PlaceOf(std::string_view key) const {
  return KeyedHash(secret_, key) % kPlaces;
}

}  // namespace trailcast::users
