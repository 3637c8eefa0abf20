#include <fmt/format.h>

#include <vector>

#include "services/route/manifest.h"
#include "services/store/route_store.h"
#include "tests/bench/console_bench.h"
#include "tests/unit/route/sample_segment.h"

namespace trailcast::bench {
namespace {

constexpr std::uint32_t kFollowedSegments = 30;
constexpr int kFeatures = 20;
constexpr std::size_t kBatch = 500;

route::RouteBuilder Teach(std::uint32_t n, std::uint32_t followed,
                          std::vector<route::SegmentPiece>* pieces) {
  route::RouteInfo info;
  info.key = {RouteId(fmt::format("{:032x}", n + 1)), TeachingId(n + 1)};
  info.name = fmt::format("aisle-{:04}", n);
  info.scout = AgentId(fmt::format("scout-{}", n % 200));
  info.camera = "webcam 320x240";
  info.image_width_px = 320;
  info.image_height_px = 240;
  info.taught_unix_ms = 1'700'000'000'000 + 1000LL * n;
  info.tags = {fmt::format("row-{}", n % 100)};
  route::RouteBuilder builder(info);
  const std::uint32_t segments = n < followed ? kFollowedSegments : 1;
  for (std::uint32_t i = 0; i < segments; ++i) {
    auto piece = builder.Add(route::SampleSegment(i, kFeatures, 2));
    if (pieces != nullptr) pieces->push_back(std::move(piece));
  }
  builder.Complete();
  return builder;
}

}  // namespace

route::RouteInfo ConsoleRoute(std::uint32_t n, std::uint32_t followed) {
  return Teach(n, followed, nullptr).info();
}

Result<void> MakeConsoleStore(const std::filesystem::path& file, std::uint32_t routes,
                              std::uint32_t followed) {
  auto store = store::OpenSqliteStore(file);
  if (!store) return tl::unexpected(store.error());
  std::vector<route::RouteInfo> infos;
  std::vector<route::SegmentPiece> pieces;
  for (std::uint32_t n = 0; n < routes; ++n) {
    infos.push_back(Teach(n, followed, &pieces).info());
    if (infos.size() < kBatch && n + 1 < routes) continue;
    if (auto put = (*store)->PutRoutes(infos); !put) return put;
    if (auto appended = (*store)->AppendSegments(pieces); !appended) return appended;
    infos.clear();
    pieces.clear();
  }
  return {};
}

}  // namespace trailcast::bench
