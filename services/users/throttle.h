#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <string>
#include <string_view>

namespace trailcast::users {

// Makes those who failed wait, twice as long each time. Its size is fixed, whatever keys strangers
// make up: a key shares its slot with others, one in kPlaces, and only a holder of `secret_` could
// choose with which. It has no clock of its own and is not thread-safe.
class Throttle {
 public:
  using Time = std::chrono::steady_clock::time_point;
  static constexpr std::size_t kPlaces = 4096;

  struct Pace {
    int free = 3;                               // failures without a wait
    std::chrono::milliseconds first{1000};      // the first wait
    std::chrono::milliseconds longest{15'000};  // the longest wait
    std::chrono::milliseconds forgets{3'600'000};
  };

  explicit Throttle(const Pace& pace);

  // Returns how long a key still has to wait; zero means that it may try.
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
