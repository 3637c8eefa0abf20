#include "tests/bench/million_routes.h"

#include <fmt/format.h>

#include <random>
#include <vector>

namespace trailcast::bench {
namespace {

constexpr std::uint32_t kBatch = 5000;
constexpr double kSite_m = 10'000.0;

}  // namespace

route::RouteInfo RouteNumber(std::uint32_t n) {
  std::mt19937 random(n);
  std::uniform_real_distribution<double> metres(0.0, kSite_m);
  route::RouteInfo info;
  info.key = {RouteId(fmt::format("{:08x}{:024x}", random(), n)), TeachingId(n % 10 + 1)};
  info.name = fmt::format("aisle-{}", n / 10);
  info.scout = AgentId(fmt::format("scout-{}", n % 200));
  info.camera = "webcam 320x240";
  info.taught_unix_ms = 1'700'000'000'000 + 1000LL * n;
  info.state = route::RouteState::kComplete;
  info.segment_count = 30;
  info.length_m = metres(random) / 100.0;
  info.bytes = 180'000;
  info.tags = {fmt::format("row-{}", n % 100), fmt::format("site-{}", n % 1000)};
  info.place = route::Place{route::Place::Frame::kSite, metres(random), metres(random)};
  return info;
}

Result<void> PutMillionRoutes(store::RouteStore& store) {
  std::vector<route::RouteInfo> batch;
  for (std::uint32_t n = 0; n < kMillion; ++n) {
    batch.push_back(RouteNumber(n));
    if (batch.size() < kBatch) continue;
    if (auto put = store.PutRoutes(batch); !put) return put;
    batch.clear();
  }
  return {};
}

}  // namespace trailcast::bench
