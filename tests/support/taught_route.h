#pragma once

#include <cstdint>
#include <vector>

#include "services/route/manifest.h"
#include "tests/unit/route/sample_segment.h"

namespace trailcast::test {

// This is a complete route as a scout leaves it, made of sample segments that decode.
struct TaughtRoute {
  route::RouteInfo info;
  std::vector<route::SegmentPiece> pieces;
};

[[nodiscard]] inline TaughtRoute TeachSamples(std::uint32_t segments, int features = 1,
                                              const std::string& name = "hall") {
  route::RouteInfo info;
  info.key = {RouteId("00112233445566778899aabbccddeeff"), TeachingId(2)};
  info.name = name;
  info.revision = RevisionNumber(2);
  info.scout = AgentId("scout-1");
  info.camera = "webcam 320x240";
  info.image_width_px = 320;
  info.image_height_px = 240;
  info.taught_unix_ms = 1'700'000'000'000;
  info.tags = {"east", "night"};
  info.place = route::Place{route::Place::Frame::kWgs84, 11.5, 48.25};
  route::RouteBuilder builder(info);
  TaughtRoute taught;
  for (std::uint32_t i = 0; i < segments; ++i) {
    taught.pieces.push_back(builder.Add(route::SampleSegment(i, features, 2)));
  }
  builder.Complete();
  taught.info = builder.info();
  return taught;
}

}  // namespace trailcast::test
