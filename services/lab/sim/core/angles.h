#pragma once

#include <numbers>

namespace trailcast::sim {

inline constexpr float kPi = std::numbers::pi_v<float>;
inline constexpr float kFullTurn = 2.0F * kPi;

}  // namespace trailcast::sim
