#include "services/catalog/orphans.h"

#include <utility>

namespace trailcast::catalog {
namespace {

constexpr std::size_t kOrphansPage = 100;

}  // namespace

Result<std::vector<store::HeldTeaching>> Orphans::Next(Time now) {
  const auto held = store_.ListHeld(last_, kOrphansPage);
  if (!held) return tl::unexpected(held.error());
  const bool at_end = held->size() < kOrphansPage;
  const route::RouteKey first = std::exchange(last_, at_end ? BeforeAll() : held->back().key);
  std::vector<store::HeldTeaching> old;
  std::map<route::RouteKey, Seen> seen;
  for (const store::HeldTeaching& teaching : *held) {
    if (teaching.known) continue;
    if (IsOld(teaching, now)) {
      old.push_back(teaching);
    } else {
      seen.insert(seen_.extract(teaching.key));
    }
  }
  // The teachings in between are orphans no more.
  std::erase_if(seen_, [&](const auto& each) {
    return each.first > first && (at_end || each.first <= last_);
  });
  seen_.merge(seen);
  return old;
}

bool Orphans::IsOld(const store::HeldTeaching& orphan, Time now) {
  Seen& seen = seen_.try_emplace(orphan.key, Seen{orphan.segments, now}).first->second;
  if (seen.segments != orphan.segments) seen = {orphan.segments, now};
  return now >= seen.since + kKept;
}

}  // namespace trailcast::catalog
