// This fuzzes what a JPEG says of itself before it is decoded, and what lies behind its end.
#include <algorithm>
#include <vector>

#include "services/image/picture_check.h"
#include "services/image/picture_run.h"
#include "services/image/src/picture_layout.h"
#include "tests/fuzz/fuzz.h"

using trailcast::fuzz::Require;
namespace image = trailcast::image;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::vector<std::uint8_t> bytes(data, data + size);
  const image::PictureLayout layout = image::ReadPictureLayout(bytes);
  Require(layout.turn() >= 1 && layout.turn() <= 8, "a picture is turned in eight ways");
  Require(layout.scans <= static_cast<std::ptrdiff_t>(size) / 2, "each scan has a marker");
  image::PictureRun run;
  const int first = run.Orientation(layout.orientation);
  (void)image::CheckPicture(bytes, 1'000'000);
  std::reverse(bytes.begin(), bytes.end());
  Require(
      !layout.orientation || run.Orientation(image::ReadPictureLayout(bytes).orientation) == first,
      "the first picture's word holds");
  std::reverse(bytes.begin(), bytes.end());
  bytes.insert(bytes.end(), {0xFF, 0xDA, 0xFF, 0xC0});
  const image::PictureLayout longer = image::ReadPictureLayout(bytes);
  Require(!layout.orientation || (longer.orientation == layout.orientation &&
                                  longer.pixels == layout.pixels && longer.scans == layout.scans),
          "what lies behind its end is no part of it");
  return 0;
}
