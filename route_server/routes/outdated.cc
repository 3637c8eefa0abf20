#include "route_server/routes/outdated.h"

#include <spdlog/spdlog.h>

namespace trailcast::server {
namespace {

using std::chrono::milliseconds;

constexpr std::chrono::hours kTellEvery{1};

}  // namespace

Result<std::vector<route::RouteInfo>> Outdated::Next(Time now) {
  const auto passed = std::chrono::floor<milliseconds>(now - aged_at_);
  aged_at_ += passed;
  if (auto kept = ages_->Pass(passed); !kept) return tl::unexpected(kept.error());
  auto outdated =
      retention_.Next([this](const auto& revisions) { return ages_->AgesOf(revisions); });
  if (!outdated || outdated->empty()) return outdated;
  const auto wanted = static_cast<std::uint32_t>(outdated->size());
  const auto allowed = ages_->Allow(wanted, most_a_day_);
  if (!allowed) return tl::unexpected(allowed.error());
  if (*allowed < wanted && now >= tell_at_) {
    tell_at_ = now + kTellEvery;
    spdlog::warn(
        "more revisions are outdated than the {} that are deleted in a day without asking, one of "
        "route '{}' among them: they wait; if they are to go sooner, raise --delete-a-day",
        most_a_day_, outdated->back().name);
  }
  outdated->resize(*allowed);
  return outdated;
}

}  // namespace trailcast::server
