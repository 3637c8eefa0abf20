#pragma once

#include <chrono>

namespace trailcast {

// The moment at which a sensor took its sample, from an arbitrary zero of that device (a
// recording's or the simulator's start, a robot's boot). Only differences have a meaning.
using SensorTime = std::chrono::nanoseconds;

[[nodiscard]] inline double Seconds(std::chrono::nanoseconds duration) {
  return std::chrono::duration<double>(duration).count();
}

[[nodiscard]] inline std::chrono::nanoseconds FromSeconds(double seconds) {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
      std::chrono::duration<double>(seconds));
}

[[nodiscard]] inline std::chrono::milliseconds ToMilliseconds(double seconds) {
  return std::chrono::duration_cast<std::chrono::milliseconds>(FromSeconds(seconds));
}

}  // namespace trailcast
