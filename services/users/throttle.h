#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <string>
#include <string_view>

namespace trailcast::users {

// Has those wait who were wrong, twice as long each time. Of a fixed size, whatever keys strangers
// make up: a key shares its place with one in kPlaces others, and who does not know `secret_`
// cannot choose with which. No clock of its own; not for several threads at once.
class Throttle {
 public:
  using Time = std::chrono::steady_clock::time_point;
  static constexpr std::size_t kPlaces = 4096;

  struct Pace {
    int free = 3;                               // so many are forgiven
    std::chrono::milliseconds first{1000};      // then so long,
    std::chrono::milliseconds longest{15'000};  // and at most
    std::chrono::milliseconds forgets{3'600'000};
  };

  explicit Throttle(const Pace& pace);

  // How long it has to wait yet; zero: it may try.
  [[nodiscard]] std::chrono::milliseconds Wait(std::string_view key, Time now) const;
  void Fail(std::string_view key, Time now);
  void Forgive(std::string_view key);

 private:
  struct Place {
    int failed = 0;
    Time last{};
    Time until{};
  };
  [[nodiscard]] std::size_t PlaceOf(std::string_view key) const;

  Pace pace_;
  std::string secret_;
  std::array<Place, kPlaces> places_{};
};

}  // namespace trailcast::users
