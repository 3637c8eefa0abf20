#include "services/refresh/successor.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "services/base/number.h"

namespace trailcast::refresh {
namespace {

constexpr std::string_view kRevision = "revision ";
constexpr std::string_view kBy = " refreshed by ";

bool AreSame(const route::Feature& a, const route::Feature& b) {
  return a.patch == b.patch && a.descriptor == b.descriptor && a.track == b.track;
}

route::Segment WithoutFeatures(route::Segment segment) {
  segment.features.clear();
  return segment;
}

}  // namespace

std::string DescribeRefreshed(RevisionNumber visited, const AgentId& by,
                              const RefreshCounts& counts) {
  return fmt::format("{}{}{}{}: {} features new, {} gone; {} of {} were found", kRevision,
                     visited.value(), kBy, by.value(), counts.added, counts.dropped, counts.found,
                     counts.found + counts.missed);
}

std::optional<RevisionNumber> RevisionRefreshed(const route::RouteInfo& info) {
  const bool tagged = std::find(info.tags.begin(), info.tags.end(), kTag) != info.tags.end();
  std::string_view text = info.description;
  const std::size_t by = text.find(kBy);
  if (!tagged || !text.starts_with(kRevision) || by == std::string_view::npos) return std::nullopt;
  text = text.substr(kRevision.size(), by - kRevision.size());
  const auto number = ParseNumber<std::uint32_t>(text);
  return number ? std::optional(RevisionNumber(*number)) : std::nullopt;
}

bool IsRefreshed(const route::Segment& segment, const route::Segment& before,
                 const RefreshOptions& options) {
  if (WithoutFeatures(segment) != WithoutFeatures(before)) return false;
  // Those that stay keep their order.
  std::size_t stayed = 0;
  auto from = before.features.begin();
  for (const route::Feature& feature : segment.features) {
    const auto found = std::find_if(from, before.features.end(), [&](const route::Feature& other) {
      return AreSame(feature, other);
    });
    if (found == before.features.end()) continue;
    ++stayed;
    from = found + 1;
  }
  const auto most = static_cast<std::size_t>(
      std::ceil(options.most_share * static_cast<double>(before.features.size())));
  return before.features.size() - stayed <= most && segment.features.size() - stayed <= most;
}

}  // namespace trailcast::refresh
