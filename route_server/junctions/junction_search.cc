#include "route_server/junctions/junction_search.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "route_server/routes/followable.h"
#include "route_server/routes/section_reader.h"
#include "services/junctions/near_routes.h"
#include "services/view/key_views.h"

namespace trailcast::server {
namespace {

// Some of a view's best matches belong to the route itself, or to other revisions of it.
constexpr std::size_t kMostAlike = 30;
// Two routes run together for longer than their most similar views show, and the junction is where
// they begin to. So many segments on either side are therefore compared as well.
constexpr std::uint32_t kMargin = 20;
constexpr std::uint32_t kPage = 100;
constexpr std::size_t kMostWaiting = 1'000;

Meeting MeetingOf(const route::RouteKey& a, const route::RouteKey& b,
                  const junctions::Junction& junction) {
  const double share = std::min(0.5, kInto_m / std::max(kInto_m, junction.length()));
  Meeting meeting{.a = a,
                  .b = b,
                  .at_a_m = std::lerp(junction.at_a, junction.end_a, share),
                  .at_b_m = std::lerp(junction.at_b, junction.end_b, share),
                  .length_m = junction.length(),
                  .confidence = junction.confidence};
  if (junction.heading_scaled) meeting.heading_rad = junction.heading_rad;
  return meeting;
}

}  // namespace

// The search for one revision.
struct JunctionSearch::Search {
  explicit Search(route::RouteInfo searched)
      : info(std::move(searched)),
        views(std::make_shared<junctions::RouteViews>(info.image_width_px)),
        near(info.key.route,
             {.most_alike = kMostAlike, .margin = kMargin, .most_routes = kMostNearRoutes}) {}

  route::RouteInfo info;
  std::shared_ptr<junctions::RouteViews> views;
  std::uint32_t next = 0;  // segment to be read
  std::deque<route::KeyView> to_look_for;
  junctions::NearRouteSearch near;

  std::optional<std::deque<junctions::NearRoute>> to_compare;  // once everything is read
  std::optional<SectionReader> reader;                         // of one of them
  std::optional<std::uint64_t> compared;                       // the number under which it is being
                                                               // compared
  route::RouteKey with;
};

JunctionSearch::JunctionSearch(store::RouteStore& store, view::ViewIndex& index,
                               JunctionComparer& comparer,
                               std::function<bool(const route::RouteKey&)> was_searched)
    : store_(store), index_(index), comparer_(comparer), was_searched_(std::move(was_searched)) {}

JunctionSearch::~JunctionSearch() = default;

void JunctionSearch::Note(const route::RouteInfo& info) {
  if (!IsJoinable(info) || was_searched_(info.key)) return;
  const bool is_searched = search_ && search_->info.key == info.key;
  const auto holds = [&](const auto& keys) {
    return std::find(keys.begin(), keys.end(), info.key) != keys.end();
  };
  if (is_searched || holds(waiting_) || holds(searched_)) return;
  if (waiting_.size() < kMostWaiting) {
    waiting_.push_back(info.key);
  } else {
    // The new walk through the store finds it.
    walked_ = false;
    cursor_.clear();
  }
}

Result<bool> JunctionSearch::Step() {
  auto stepped = TryStep();
  if (stepped || !search_) return stepped;
  if (stepped.error().code == ErrorCode::kUnavailable) waiting_.push_front(search_->info.key);
  search_.reset();
  return stepped;
}

Result<bool> JunctionSearch::TryStep() {
  Result<void> done;
  if (!search_) {
    if (waiting_.empty() && walked_) return false;
    if (waiting_.empty()) {
      done = ReadPage();
    } else {
      done = Begin(waiting_.front());
    }
  } else if (search_->compared) {
    return false;
  } else if (!search_->to_look_for.empty()) {
    search_->near.Look(index_, search_->to_look_for.front().features);
    search_->to_look_for.pop_front();
  } else if (!search_->to_compare) {
    done = Read(*search_);
  } else {
    done = StepToNear(*search_);
  }
  if (!done) return tl::unexpected(done.error());
  return true;
}

Result<void> JunctionSearch::ReadPage() {
  const auto page = store_.QueryRoutes({.page_size = kPage, .cursor = cursor_});
  if (!page) {
    walked_ = page.error().code != ErrorCode::kUnavailable;
    return tl::unexpected(page.error());
  }
  for (const route::RouteInfo& info : page->routes) Note(info);
  cursor_ = page->next;
  walked_ = cursor_.empty();
  return {};
}

Result<void> JunctionSearch::Begin(const route::RouteKey& key) {
  auto info = FindJoinable(store_, key);
  if (!info) return tl::unexpected(info.error());
  waiting_.pop_front();
  if (*info) search_ = std::make_unique<Search>(**std::move(info));
  return {};
}

Result<void> JunctionSearch::Read(Search& search) {
  if (search.next < std::min(search.info.segment_count, SectionReader::kMost)) {
    const auto segment = ReadSegment(store_, search.info.key, SegmentIndex(search.next));
    if (!segment) return tl::unexpected(segment.error());
    search.views->Add(*segment);
    for (route::KeyView& view : view::ScoutViewsOf(*segment)) {
      search.to_look_for.push_back(std::move(view));
    }
    ++search.next;
    return {};
  }
  const auto near = search.near.Found();
  search.to_compare.emplace(near.begin(), near.end());
  Compare(search, nullptr, search.info);
  return {};
}

Result<void> JunctionSearch::StepToNear(Search& search) {
  if (search.reader) {
    const auto read = search.reader->Step(store_);
    // A route that cannot be read now offers no place to change over.
    if (!read && read.error().code == ErrorCode::kUnavailable) return tl::unexpected(read.error());
    if (read && !*read) return {};
    if (read) Compare(search, search.reader->TakeViews(), search.reader->info());
    search.reader.reset();
    return {};
  }
  if (search.to_compare->empty()) {
    searched_.push_back(search.info.key);
    search_.reset();
    return {};
  }
  const junctions::NearRoute near = std::move(search.to_compare->front());
  search.to_compare->pop_front();
  auto info = FindJoinable(store_, near.key);
  if (!info) return tl::unexpected(info.error());
  if (*info) search.reader.emplace(**std::move(info), near.first, near.last);
  return {};
}

void JunctionSearch::Compare(Search& search, JunctionComparer::Views other,
                             const route::RouteInfo& of) {
  search.with = of.key;
  search.compared =
      comparer_.TryPut(search.views, std::move(other), search.info.camera == of.camera);
}

void JunctionSearch::Handle(const JunctionComparer::Done& done) {
  if (!search_ || search_->compared != done.number) return;
  search_->compared.reset();
  if (!done.junctions) return;
  for (const junctions::Junction& junction : *done.junctions) {
    meetings_.push_back(MeetingOf(search_->info.key, search_->with, junction));
  }
}

}  // namespace trailcast::server
