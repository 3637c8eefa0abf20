#include "agent/duty/src/routes_seen.h"

#include <algorithm>
#include <utility>

#include "services/route/codec.h"
#include "services/view/any_camera.h"

namespace trailcast::agent {
namespace {

constexpr std::size_t kMostSegments = 500;
constexpr std::size_t kMostRoutes = 3;

}  // namespace

std::vector<std::string> RoutesSeen(store::RouteStore& store,
                                    const std::vector<route::ViewFeature>& view) {
  const view::AnyCameraView seen(view);
  std::vector<std::pair<double, std::string>> found;
  const auto page = store.QueryRoutes(
      {.state = route::RouteState::kComplete, .page_size = store::RouteStore::kMaxPage});
  if (!page) return {};
  std::size_t looked_at = 0;
  for (const route::RouteInfo& info : page->routes) {
    if (info.standing == route::Standing::kRetired) continue;
    double likest = 0.0;
    for (std::uint32_t i = 0; i < info.segment_count && looked_at < kMostSegments; ++i) {
      ++looked_at;
      const auto piece = store.ReadSegment(info.key, SegmentIndex(i));
      if (!piece) continue;
      const auto segment = route::Decode(piece->bytes);
      if (!segment) continue;
      const view::ViewMatch match = seen.MatchWith(*segment);
      if (match.found()) likest = std::max(likest, match.likeness);
    }
    if (likest > 0.0) found.emplace_back(likest, info.name);
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<std::string> names;
  for (auto& [likeness, name] : found) {
    const bool is_new = std::find(names.begin(), names.end(), name) == names.end();
    if (is_new && names.size() < kMostRoutes) names.push_back(std::move(name));
  }
  return names;
}

}  // namespace trailcast::agent
