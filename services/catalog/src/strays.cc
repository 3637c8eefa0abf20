#include "services/catalog/strays.h"

#include <utility>

namespace trailcast::catalog {
namespace {

constexpr std::size_t kStraysPage = 100;

}  // namespace

Result<std::vector<store::HeldTeaching>> Strays::Next(Time now) {
  const auto held = store_.ListHeld(last_, kStraysPage);
  if (!held) return tl::unexpected(held.error());
  const bool at_end = held->size() < kStraysPage;
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

bool Strays::IsOld(const store::HeldTeaching& stray, Time now) {
  Seen& seen = seen_.try_emplace(stray.key, Seen{stray.segments, now}).first->second;
  if (seen.segments != stray.segments) seen = {stray.segments, now};
  return now >= seen.since + kKept;
}

}  // namespace trailcast::catalog
