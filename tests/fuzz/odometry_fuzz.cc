// Wheel odometry of recorded runs.
#include <array>
#include <cmath>

#include "agent/device/odometry_file.h"
#include "tests/fuzz/fuzz.h"

using trailcast::fuzz::Require;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto odometry =
      trailcast::agent::OdometryFile::Read(trailcast::fuzz::AsFile({data, size}, "odometry.csv"));
  if (!odometry) return 0;
  for (const double t_s : std::array{-0.4, 0.0, 0.1, 0.5, 1.0, 2.0, 60.0, 1e6}) {
    const auto pose = odometry->At(trailcast::FromSeconds(t_s));
    Require(!pose || (std::isfinite(pose->x_m) && std::isfinite(pose->y_m) &&
                      std::isfinite(pose->heading_rad)),
            "a pose is finite");
  }
  return 0;
}
