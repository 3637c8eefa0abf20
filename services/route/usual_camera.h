#pragma once

namespace trailcast::route {

// These are assumed of a robot of which nothing better is known: the focal length of a usual
// webcam, as a share of its picture's width, and a walking pace that any robot can drive.
inline constexpr double kUsualFocalShare = 0.87;
inline constexpr double kUsualSpeed_mps = 0.3;

}  // namespace trailcast::route
