// Way-points for the simulator, and the curve that is driven along them.
#include "services/lab/sim/core/path.h"

#include "tests/fuzz/fuzz.h"

using trailcast::fuzz::Require;
namespace sim = trailcast::sim;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto path = sim::ReadPath(trailcast::fuzz::AsFile({data, size}, "path.csv"));
  if (!path) return 0;
  Require(path->points.size() >= 2, "a path has two points");
  const double length_m = sim::Length(path->points);
  Require(std::isfinite(length_m) && length_m > 0.0, "a path has a length");
  Require(std::isfinite(sim::StartPose(path->points).heading_rad), "a path has a beginning");
  const sim::Polyline driven = sim::RoundCorners(path->points, 1.0, 0.5);
  for (const Eigen::Vector2d& point : driven) Require(point.allFinite(), "it can be driven");
  const sim::PlaceOnPath place = sim::Nearest(driven, path->points.back());
  Require(std::isfinite(place.along_m), "every place has a nearest one on the path");
  return 0;
}
