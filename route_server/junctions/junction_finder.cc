#include "route_server/junctions/junction_finder.h"

#include <utility>

namespace trailcast::server {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

// Everything else waits for so long, and for the part that is being done then.
constexpr milliseconds kATurn{3};
constexpr int kRestsATurn = 3;  // in lengths of a turn
constexpr milliseconds kAfterTrouble{1000};

}  // namespace

JunctionFinder::JunctionFinder(store::RouteStore& store, catalog::ViewCatalog& views,
                               std::function<bool(const route::RouteKey&)> was_searched)
    : views_(views),
      search_(store, views.index(), comparer_, std::move(was_searched)),
      crossings_(store, views.index(), comparer_) {}

Result<void> JunctionFinder::Turn(Time now) {
  if (now < due_) return {};
  Result<void> compared;
  while (const auto done = comparer_.TryGet()) {
    search_.Handle(*done);
    crossings_.Handle(*done);
    if (!done->junctions) compared = tl::unexpected(done->junctions.error());
  }
  const auto began = steady_clock::now();
  Result<bool> stepped = true;
  while (stepped && *stepped && steady_clock::now() - began < kATurn) stepped = Step();
  const auto ended = steady_clock::now();
  busy_ = !stepped || *stepped;
  due_ = ended + kRestsATurn * (ended - began);
  if (stepped) return compared;
  if (stepped.error().code == ErrorCode::kUnavailable) due_ = ended + kAfterTrouble;
  return tl::unexpected(stepped.error());
}

Result<bool> JunctionFinder::Step() {
  auto stepped = crossings_.Step();
  if (!stepped || *stepped) return stepped;
  // A route that is not in the index yet would not be found.
  if (!views_.Filled()) return false;
  return search_.Step();
}

}  // namespace trailcast::server
