// The messages of a recorded drive, and the grey pictures that are made of them.
#include <cmath>

#include "services/bag/ros_messages.h"
#include "tests/fuzz/fuzz.h"

using trailcast::fuzz::Require;
namespace bag = trailcast::bag;
namespace image = trailcast::image;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::span message(data, size);
  if (const auto read = bag::ReadImage(message)) {
    image::PictureRun run;
    const auto gray = image::GrayFromRaw(read->picture, run);
    Require(!gray || gray->pixels.size() <= size, "a picture is no larger than its message");
  }
  if (const auto read = bag::ReadCompressedImage(message)) {
    Require(read->bytes.size() < size, "a picture is in its message");
  }
  if (const auto read = bag::ReadOdometry(message)) {
    Require(std::isfinite(read->pose.x_m) && std::isfinite(read->pose.y_m) &&
                std::isfinite(read->pose.heading_rad),
            "a pose is finite");
  }
  for (const bool stamped : {false, true}) {
    const auto read = bag::ReadTwist(message, stamped);
    Require(!read || (std::isfinite(read->linear_mps) && std::isfinite(read->angular_radps)),
            "a command is finite");
  }
  return 0;
}
