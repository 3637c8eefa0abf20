#pragma once

#include <string>
#include <vector>

#include "services/photos/photo.h"
#include "services/route/digest.h"

namespace trailcast::photos {

// Bytes that stand for a JPEG.
inline std::vector<std::uint8_t> SomeJpeg(std::size_t bytes, std::uint8_t filled = 7) {
  return std::vector<std::uint8_t>(bytes, filled);
}

inline Photo APhoto(char digit, const std::vector<std::uint8_t>& jpeg) {
  return {.id = std::string(16, digit),
          .robot = AgentId("robot2"),
          .mission = "4f2a09c1",
          .route = "hall",
          .revision = 3,
          .along_m = 12.61,
          .spot_m = 12.5,
          .taken_unix_ms = 1'700'000'000'000 + digit,
          .width_px = 640,
          .height_px = 480,
          .bytes = static_cast<std::uint32_t>(jpeg.size()),
          .digest = route::Sha256(jpeg)};
}

}  // namespace trailcast::photos
