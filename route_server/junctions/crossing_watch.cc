#include "route_server/junctions/crossing_watch.h"

#include <algorithm>
#include <map>

#include "route_server/junctions/meeting.h"
#include "route_server/routes/section_reader.h"
#include "services/junctions/near_routes.h"
#include "services/view/key_views.h"

namespace trailcast::server {
namespace {

constexpr std::size_t kMostAlike = 30;  // of which some belong to the teaching itself
constexpr std::size_t kLeastViews = 3;
constexpr std::size_t kViewsASegment = 1;  // of several, because querying the index is what takes
                                           // time
constexpr std::size_t kDoubtsASegment = 2;
constexpr std::size_t kMostDoubts = 8;
// A scout that goes along a route is told of it once, as long as no more segments than this lie
// between two that resemble the route.
constexpr std::uint32_t kStillThere = 20;

}  // namespace

// The end of a teaching, as far as it has come.
struct CrossingWatch::Teaching {
  explicit Teaching(route::RouteInfo taught)
      : info(std::move(taught)),
        near(info.key.route,
             {.most_alike = kMostAlike, .least_views = kLeastViews, .most_sections = 1}) {}

  [[nodiscard]] JunctionComparer::Views Views() const {
    auto views = std::make_shared<junctions::RouteViews>(info.image_width_px);
    for (const route::Segment& segment : last) views->Add(segment);
    return views;
  }
  // Says whether the scout is known to be there, and keeps it there.
  [[nodiscard]] bool IsThere(const junctions::NearRoute& place) {
    const auto at = there.find(place.key);
    if (at == there.end()) return false;
    const std::uint32_t now = place.last.value();
    const std::uint32_t moved = std::max(at->second, now) - std::min(at->second, now);
    if (moved > kStillThere) return false;
    at->second = now;
    return true;
  }

  route::RouteInfo info;
  std::deque<route::Segment> last;
  junctions::NearRouteSearch near;
  std::map<route::RouteKey, std::uint32_t> there;  // routes it was told of, with their segments
};

// A possible crossing between a teaching and a route.
struct CrossingWatch::Doubt {
  route::RouteKey teaching;
  junctions::NearRoute place;
  std::string camera;
  JunctionComparer::Views views;            // of the teaching
  std::optional<SectionReader> reader{};    // of the route
  std::optional<std::uint64_t> compared{};  // the number under which it is being compared
};

CrossingWatch::CrossingWatch(store::RouteStore& store, view::ViewIndex& index,
                             JunctionComparer& comparer)
    : store_(store), index_(index), comparer_(comparer) {}

CrossingWatch::~CrossingWatch() = default;

void CrossingWatch::NoteStored(const route::RouteKey& key, SegmentIndex segment) {
  arrived_.emplace_back(key, segment);
  if (arrived_.size() > kMostArrived) arrived_.pop_front();
}

Result<bool> CrossingWatch::Step() {
  Result<void> done;
  if (!doubts_.empty() && doubts_.front().reader) {
    Doubt& doubt = doubts_.front();
    const auto read = doubt.reader->Step(store_);
    if (read && !*read) return true;
    if (read) {
      const auto& of = doubt.reader->info();
      doubt.compared =
          comparer_.TryPut(doubt.views, doubt.reader->TakeViews(), doubt.camera == of.camera);
    } else {
      done = tl::unexpected(read.error());
    }
    doubt.reader.reset();
    if (!doubt.compared) doubts_.erase(doubts_.begin());
  } else if (!doubts_.empty() && !doubts_.front().compared) {
    done = Begin(doubts_.front());
  } else if (!arrived_.empty()) {
    const auto [key, segment] = std::move(arrived_.front());
    arrived_.pop_front();
    done = LookAt(key, segment);
  } else {
    return false;
  }
  if (!done) return tl::unexpected(done.error());
  return true;
}

Result<void> CrossingWatch::Begin(Doubt& doubt) {
  auto known = FindJoinable(store_, doubt.place.key);
  if (known && *known) {
    doubt.reader.emplace(**std::move(known), doubt.place.first, doubt.place.last);
    return {};
  }
  doubts_.erase(doubts_.begin());
  if (!known) return tl::unexpected(known.error());
  return {};
}

Result<void> CrossingWatch::LookAt(const route::RouteKey& key, SegmentIndex index) {
  auto segment = ReadSegment(store_, key, index);
  if (!segment) return tl::unexpected(segment.error());
  auto& teaching = teachings_.Touch(key);
  const bool follows_on = teaching && !teaching->last.empty() &&
                          teaching->last.back().index.value() + 1 == index.value();
  if (!follows_on) {
    auto info = store_.FindRoute(key);
    if (!info) return tl::unexpected(info.error());
    if (!*info) return {};  // nothing is known of it yet
    auto known_there = teaching ? std::move(teaching->there) : decltype(Teaching::there){};
    teaching = std::make_shared<Teaching>(**std::move(info));
    teaching->there = std::move(known_there);
  }
  auto views = view::KeyViewsOf(*segment);
  views.resize(std::min(views.size(), kViewsASegment));
  for (const route::KeyView& view : views) teaching->near.Look(index_, view.features);
  teaching->near.KeepLast(kLast * kViewsASegment);
  teaching->last.push_back(*std::move(segment));
  if (teaching->last.size() > kLast) teaching->last.pop_front();
  Suspect(*teaching);
  return {};
}

void CrossingWatch::Suspect(Teaching& teaching) {
  std::size_t suspected = 0;
  for (const junctions::NearRoute& place : teaching.near.Found()) {
    if (teaching.IsThere(place)) continue;
    const bool waits = std::any_of(doubts_.begin(), doubts_.end(), [&](const Doubt& doubt) {
      return doubt.teaching == teaching.info.key && doubt.place.key == place.key;
    });
    if (waits || suspected == kDoubtsASegment || doubts_.size() >= kMostDoubts) continue;
    ++suspected;
    doubts_.push_back({teaching.info.key, place, teaching.info.camera, teaching.Views()});
  }
}

void CrossingWatch::Handle(const JunctionComparer::Done& done) {
  if (doubts_.empty() || doubts_.front().compared != done.number) return;
  const Doubt doubt = std::move(doubts_.front());
  doubts_.erase(doubts_.begin());
  const auto* teaching = teachings_.Find(doubt.teaching);
  // The first junction is the surest one.
  if (!done.junctions || done.junctions->empty() || done.junctions->front().confidence < kSure)
    return;
  if (teaching == nullptr || !*teaching) return;
  const auto known = store_.FindRoute(doubt.place.key);
  if (!known || !*known) return;
  (*teaching)->there[doubt.place.key] = doubt.place.last.value();
  crossings_.push_back({(*teaching)->info, (*known)->name, done.junctions->front().at_b});
}

}  // namespace trailcast::server
