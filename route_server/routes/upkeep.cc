#include "route_server/routes/upkeep.h"

#include <spdlog/spdlog.h>

#include <utility>

#include "services/route/labels.h"

namespace trailcast::server {
namespace {

constexpr std::chrono::milliseconds kEvery{1'000};

}  // namespace

void Upkeep::Tick(Time now) {
  if (now < due_) return;
  due_ = now + kEvery;
  if (const auto news = watch_.Look(now)) {
    spdlog::log(watch_.trouble().empty() ? spdlog::level::info : spdlog::level::err, "{}", *news);
  }
  if (!watch_.trouble().empty()) return;
  for (auto see_to : {&Upkeep::SeeToRoutes, &Upkeep::SeeToOrphans}) {
    const auto seen = (this->*see_to)(now);
    if (seen) continue;
    if (std::exchange(told_, seen.error().message) != told_) {
      spdlog::warn("looking through the store: {}", told_);
    }
  }
}

Result<void> Upkeep::SeeToRoutes(Time now) {
  const auto partial = partial_.Look();
  for (const store::LackingRoute& route : partial_.TakeUntold(now)) {
    spdlog::warn(
        "{} is served in part: {} lacking here; its scout, other servers and followers are asked "
        "for what they have of it",
        route::Describe(route.info),
        store::DescribeSegments(route.segments) + (route.segments.size() == 1 ? " is" : " are"));
  }
  if (!partial) return tl::unexpected(partial.error());
  for (const route::RouteKey& key : *partial) keeper_.Attend(key, now);
  return {};
}

Result<void> Upkeep::SeeToOrphans(Time now) {
  const auto orphans = orphans_.Next(now);
  if (!orphans) return tl::unexpected(orphans.error());
  for (const store::HeldTeaching& orphan : *orphans) {
    const auto dropped = keeper_.DropOrphan(orphan.key);
    if (!dropped) return tl::unexpected(dropped.error());
    if (!*dropped) continue;
    dropped_orphans_ += orphan.segments;
    spdlog::info("{} segments of {} are dropped: nobody announced it for a day", orphan.segments,
                 route::Describe(orphan.key));
  }
  return {};
}

std::vector<exchange::LackingSegments> Upkeep::LackingOf(
    const std::vector<route::RouteInfo>& routes) const {
  std::vector<exchange::LackingSegments> lacking;
  if (partial_.routes() == 0) return lacking;
  for (const route::RouteInfo& info : routes) {
    const auto segments = static_cast<std::uint32_t>(partial_.LackingOf(info.key));
    if (segments > 0) lacking.push_back({info.key, segments});
  }
  return lacking;
}

std::string Upkeep::Degraded() const {
  if (partial_.routes() == 0) return "";
  return fmt::format("{} {} {} of {} segments here", partial_.routes(),
                     partial_.routes() == 1 ? "route is" : "routes are", "served without some",
                     partial_.segments());
}

}  // namespace trailcast::server
