#pragma once

namespace trailcast {

inline double Square(double x) { return x * x; }

}  // namespace trailcast
