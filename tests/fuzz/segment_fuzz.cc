// The route format: what is decoded encodes to bytes that decode to the same, and a piece opens
// only with its own digest and index; and what is drawn of it.
#include <cmath>

#include "services/console/src/shape.h"
#include "services/route/codec.h"
#include "services/route/digest.h"
#include "tests/fuzz/fuzz.h"

using trailcast::SegmentIndex;
using trailcast::fuzz::Require;
namespace route = trailcast::route;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::span bytes(data, size);
  const auto segment = route::Decode(bytes);
  if (!segment) return 0;
  Require(segment->features.size() <= route::kMaxFeatures, "features are bounded");
  const route::Bytes encoded = route::Encode(*segment);
  const auto again = route::Decode(encoded);
  Require(again && *again == *segment, "what was decoded survives encoding");
  Require(route::Encode(*again) == encoded, "equal segments give equal bytes");

  trailcast::console::ShapeMaker maker(320);
  maker.Add(*segment);
  maker.Add(*segment);
  for (const auto& point : maker.Shape().points) {
    Require(std::isfinite(point.x_m) && std::isfinite(point.y_m), "it can be drawn");
  }

  route::SegmentPiece piece{.key = {},
                            .index = segment->index,
                            .digest = route::Sha256(bytes),
                            .bytes = {bytes.begin(), bytes.end()}};
  const auto opened = route::Open(piece);
  Require(opened && *opened == *segment, "a whole piece opens");
  piece.index = SegmentIndex(piece.index.value() + 1);
  Require(!route::Open(piece), "a piece of another index does not open");
  piece.index = segment->index;
  piece.bytes[size / 2] ^= 1U;
  Require(!route::Open(piece), "a piece with a changed bit does not open");
  return 0;
}
