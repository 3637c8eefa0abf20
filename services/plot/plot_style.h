#pragma once

#include <vector>

#include "services/image/canvas.h"

namespace trailcast::plot {

// The style that all plots share. Its colours of curves and paths can be told apart by people who
// do not see all colours (Okabe and Ito's palette).
inline constexpr image::Color kWhite{255, 255, 255};
inline constexpr image::Color kInk{40, 40, 40};
inline constexpr image::Color kGrid{225, 225, 225};
inline constexpr image::Color kBlack{0, 0, 0};
inline constexpr image::Color kOrange{213, 94, 0};
inline constexpr image::Color kBlue{0, 114, 178};
inline constexpr image::Color kGreen{0, 158, 115};

// Returns 1, 2 or 5 times a power of ten, such that about `count` ticks fit into `length`.
[[nodiscard]] double TickStep(double length, double count);
// Returns the multiples of `step` from `from` to `to`.
[[nodiscard]] std::vector<double> Ticks(double from, double to, double step);
[[nodiscard]] inline std::vector<double> RoundTicks(double from, double to, double count) {
  return Ticks(from, to, TickStep(to - from, count));
}

}  // namespace trailcast::plot
