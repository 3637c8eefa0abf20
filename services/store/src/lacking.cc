#include "services/store/lacking.h"

#include <fmt/ranges.h>

#include <algorithm>

#include "services/route/labels.h"

namespace trailcast::store {

Result<std::vector<SegmentIndex>> FindLacking(RouteStore& store, const route::RouteInfo& info) {
  std::vector<SegmentIndex> lacking;
  if (info.state != route::RouteState::kComplete) return lacking;
  const auto held = store.HeldSegments(info.key);
  if (!held) return tl::unexpected(held.error());
  auto next = held->begin();
  for (std::uint32_t i = 0; i < info.segment_count; ++i) {
    if (next != held->end() && next->value() == i) {
      ++next;
    } else {
      lacking.emplace_back(i);
    }
  }
  return lacking;
}

Result<std::vector<LackingRoute>> FindLacking(RouteStore& store) {
  const auto routes = store.ListRoutes();
  if (!routes) return tl::unexpected(routes.error());
  std::vector<LackingRoute> found;
  for (const route::RouteInfo& info : *routes) {
    auto lacking = FindLacking(store, info);
    if (!lacking) return tl::unexpected(lacking.error());
    if (!lacking->empty()) found.push_back({info, std::move(*lacking)});
  }
  return found;
}

std::string DescribeSegments(const std::vector<SegmentIndex>& rising) {
  constexpr std::size_t kMostRuns = 10;
  std::vector<std::string> runs;
  std::size_t told = 0;
  for (std::size_t i = 0; i < rising.size() && runs.size() < kMostRuns; told = ++i) {
    const std::uint32_t first = rising[i].value();
    while (i + 1 < rising.size() && rising[i + 1].value() == rising[i].value() + 1) ++i;
    const std::uint32_t last = rising[i].value();
    runs.push_back(first == last ? std::to_string(first) : fmt::format("{} to {}", first, last));
  }
  std::string text =
      fmt::format("{} {}", rising.size() == 1 ? "segment" : "segments", fmt::join(runs, ", "));
  if (told < rising.size()) text += fmt::format(" and {} more", rising.size() - told);
  return text;
}

std::string Describe(const LackingRoute& lacking) {
  return fmt::format("{} of {} ({})", DescribeSegments(lacking.segments),
                     route::Describe(lacking.info), route::Describe(lacking.info.key));
}

}  // namespace trailcast::store
