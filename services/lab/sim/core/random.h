#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <string_view>

namespace trailcast::sim {

// Seeded random numbers that are the same with every standard library. The standard fixes its
// generator's sequence, but not its distributions, so these are written out here.
class Random {
 public:
  // Streams of one seed with different names are independent, so that an additional draw in one
  // part (a new disturbance, say) leaves all the others as they were.
  Random(std::uint64_t seed, std::string_view stream) : generator_(Mix(seed, stream)) {}

  [[nodiscard]] std::uint64_t Bits() { return generator_(); }
  // Draws from [0, 1).
  [[nodiscard]] double Uniform() { return static_cast<double>(generator_() >> 11U) * 0x1.0p-53; }
  [[nodiscard]] double Uniform(double low, double high) { return low + (high - low) * Uniform(); }
  [[nodiscard]] int Integer(int low, int high) {
    return low + static_cast<int>(Uniform() * (high - low + 1));
  }
  // Draws with mean 0 and standard deviation 1 (Box and Muller).
  [[nodiscard]] double Normal() {
    const double radius = std::sqrt(-2.0 * std::log(1.0 - Uniform()));
    return radius * std::cos(2.0 * std::numbers::pi * Uniform());
  }

 private:
  static std::uint64_t Mix(std::uint64_t seed, std::string_view stream) {
    std::uint64_t hash = 14695981039346656037ULL ^ seed;  // FNV-1a over the name
    for (const char c : stream) {
      hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211ULL;
    }
    return hash ^ (seed * 0x9E3779B97F4A7C15ULL);
  }

  std::mt19937_64 generator_;
};

}  // namespace trailcast::sim
