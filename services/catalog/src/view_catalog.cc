#include "services/catalog/view_catalog.h"

#include <algorithm>
#include <utility>

#include "services/exchange/bounds.h"
#include "services/route/codec.h"

namespace trailcast::catalog {
namespace {

constexpr std::uint32_t kViewsPage = store::RouteStore::kMaxPage;
// How many candidates are read and compared feature by feature for one view. The neighbours of the
// right one follow it soon, but an uncertain one may come late.
constexpr std::size_t kViewsCompared = 100;
constexpr std::size_t kComparedOnceSure = 30;
constexpr double kSure = 0.5;
constexpr std::size_t kComparedAround = 8;  // on either side of the best one, along its route

// Bytes that are whole but cannot be decoded are as their scout sent them, so they are no damage.
Result<route::Segment> Decoded(const route::SegmentPiece& piece) {
  auto segment = route::Decode(piece.bytes);
  if (segment) segment->index = piece.index;
  return segment;
}

bool IsSure(const route::FoundPlace& place) { return place.score >= kSure; }

bool LikestFirst(const route::FoundPlace& a, const route::FoundPlace& b) {
  return a.score > b.score;
}

}  // namespace

ViewCatalog::ViewCatalog(store::RouteStore& store, const view::ViewIndexOptions& options)
    : store_(store), index_(options) {}

bool ViewCatalog::Filled() const {
  const bool nothing_left = walked_ && page_.empty() && noted_.empty() && segments_.empty();
  return nothing_left || index_.full();
}

Result<void> ViewCatalog::Fill(std::size_t most) {
  Result<void> first_error;
  for (; most > 0 && !Filled(); --most) {
    auto done = FillOne();
    if (done) continue;
    if (done.error().code == ErrorCode::kUnavailable) return done;
    if (first_error) first_error = std::move(done);
  }
  return first_error;
}

Result<void> ViewCatalog::FillOne() {
  if (!segments_.empty()) return IndexNext();
  if (!noted_.empty()) return LookAt(noted_.extract(noted_.begin()).value());
  if (page_.empty()) return ReadPage();
  const route::RouteKey key = std::move(page_.front());
  page_.pop_front();
  return LookAt(key);
}

Result<void> ViewCatalog::ReadPage() {
  const auto page = store_.QueryRoutes({.page_size = kViewsPage, .cursor = cursor_});
  if (!page) {
    // Without the page nobody knows where to continue.
    walked_ = page.error().code != ErrorCode::kUnavailable;
    return tl::unexpected(page.error());
  }
  for (const route::RouteInfo& info : page->routes) page_.push_back(info.key);
  cursor_ = page->next;
  walked_ = cursor_.empty();
  return {};
}

Result<void> ViewCatalog::LookAt(const route::RouteKey& key) {
  const auto held = store_.HeldSegments(key);
  if (!held) {
    if (held.error().code == ErrorCode::kUnavailable) noted_.insert(key);
    return tl::unexpected(held.error());
  }
  for (const SegmentIndex segment : *held) {
    const Place place{key, segment};
    if (!index_.Holds(place) && !unreadable_.contains(place)) segments_.push_back(place);
  }
  return {};
}

Result<void> ViewCatalog::IndexNext() {
  const Place place = std::move(segments_.front());
  segments_.pop_front();
  if (index_.Holds(place)) return {};
  return Index(place, Read(place));
}

Result<void> ViewCatalog::Add(const route::SegmentPiece& piece) {
  const Place place{piece.key, piece.index};
  unreadable_.erase(place);
  if (index_.full() || index_.Holds(place)) return {};
  return Index(place, Decoded(piece));
}

Result<void> ViewCatalog::Index(const Place& place, const Result<route::Segment>& segment) {
  if (!segment) {
    if (segment.error().code == ErrorCode::kUnavailable) {
      segments_.push_front(place);
    } else if (segment.error().code != ErrorCode::kNotFound) {
      unreadable_.insert(place);
    }
    return tl::unexpected(segment.error());
  }
  std::ignore = index_.Add(place.key, *segment);  // the index is not full, or nothing would be read
  return {};
}

Result<route::Segment> ViewCatalog::Read(const Place& place) {
  const auto piece = store_.ReadSegment(place.key, place.segment);
  if (!piece) {
    if (piece.error().code == ErrorCode::kCorrupt) damaged_.push_back(place);
    return tl::unexpected(piece.error());
  }
  return Decoded(*piece);
}

void ViewCatalog::Note(const route::RouteKey& key) {
  // Strangers can make up routes, so the number is bounded. The walk after the next start finds the
  // rest.
  constexpr std::size_t kMostNoted = 65'536;
  if (!index_.full() && noted_.size() < kMostNoted) noted_.insert(key);
}

std::vector<view::ViewIndex::Place> ViewCatalog::TakeDamaged() {
  return std::exchange(damaged_, {});
}

void ViewCatalog::Forget(const route::RouteKey& key) {
  const auto of_route = [&](const Place& place) { return place.key == key; };
  index_.Remove(key);
  noted_.erase(key);
  std::erase(page_, key);
  std::erase_if(segments_, of_route);
  std::erase_if(unreadable_, of_route);
}

Result<std::optional<route::FoundPlace>> ViewCatalog::Compare(const Place& place,
                                                              const Matcher& matcher) {
  const auto segment = Read(place);
  if (!segment && segment.error().code == ErrorCode::kNotFound) {
    Forget(place.key);
    return std::nullopt;
  }
  if (!segment) return tl::unexpected(segment.error());
  const view::ViewMatch match = matcher(*segment);
  if (!match.found()) return std::nullopt;
  return route::FoundPlace{place.key, place.segment, match.score()};
}

Result<std::vector<route::FoundPlace>> ViewCatalog::FindBy(const std::vector<Place>& candidates,
                                                           const Matcher& matcher) {
  std::vector<route::FoundPlace> found;
  std::size_t compared = 0;
  bool sure = false;
  for (const Place& place : candidates) {
    if (sure && compared >= kComparedOnceSure) break;
    ++compared;
    auto match = Compare(place, matcher);
    if (!match) return tl::unexpected(match.error());
    if (!*match) continue;
    sure = sure || IsSure(**match);
    found.push_back(std::move(**match));
  }
  std::stable_sort(found.begin(), found.end(), LikestFirst);
  return found;
}

// The index finds similar views, but cannot tell which of a few neighbouring places is the most
// similar.
Result<void> ViewCatalog::LookAround(std::vector<route::FoundPlace>& found,
                                     const Matcher& matcher) {
  if (found.empty()) return {};
  const Place best{found.front().key, found.front().segment};
  for (const Place& place : index_.Around(best, kComparedAround)) {
    const bool known = std::any_of(found.begin(), found.end(), [&](const auto& other) {
      return other.key == place.key && other.segment == place.segment;
    });
    if (known) continue;
    auto match = Compare(place, matcher);
    if (!match) return tl::unexpected(match.error());
    if (*match) found.push_back(std::move(**match));
  }
  std::stable_sort(found.begin(), found.end(), LikestFirst);
  return {};
}

Result<std::vector<route::FoundPlace>> ViewCatalog::Find(const route::View& seen) {
  // Features of unknown size come first.
  const auto sized = std::find_if(seen.begin(), seen.end(),
                                  [](const auto& feature) { return feature.size_px > 0.0F; });
  const std::span<const route::ViewFeature> as_scout(seen.begin(), sized);
  const std::span<const route::ViewFeature> by_size(sized, seen.end());
  auto found =
      FindBy(index_.Candidates(as_scout, kViewsCompared),
             [&](const route::Segment& segment) { return view::Match(as_scout, segment); });
  if (!found || by_size.empty() || (!found->empty() && IsSure(found->front()))) return found;
  const view::AnyCameraView any_camera(by_size);
  const auto matcher = [&](const route::Segment& segment) { return any_camera.MatchWith(segment); };
  auto found_by_any = FindBy(index_.Candidates(by_size, kViewsCompared), matcher);
  if (!found_by_any) return found_by_any;
  if (auto done = LookAround(*found_by_any, matcher); !done) return tl::unexpected(done.error());
  const bool likelier = !found_by_any->empty() &&
                        (found->empty() || LikestFirst(found_by_any->front(), found->front()));
  return likelier ? found_by_any : found;
}

Result<void> ViewCatalog::FillReply(exchange::CatalogReply& reply, const route::RouteQuery& query) {
  if (auto possible = exchange::CheckQuery(query); !possible) return possible;
  auto found = Find(query.view);
  if (!found) return tl::unexpected(found.error());
  const std::size_t most =
      query.page_size == 0 ? exchange::kMaxPlacesPerReply
                           : std::min<std::size_t>(query.page_size, exchange::kMaxPlacesPerReply);
  for (route::FoundPlace& place : *found) {
    if (reply.places.size() == most) break;
    auto info = store_.FindRoute(place.key);
    if (!info) return tl::unexpected(info.error());
    if (!*info) continue;  // its segments arrived before the route's description
    reply.places.push_back(std::move(place));
    reply.page.routes.push_back(std::move(**info));
  }
  reply.page.total = reply.page.routes.size();
  const auto stored = store_.QueryRoutes({.page_size = 1});
  if (!stored) return tl::unexpected(stored.error());
  reply.coverage.segments_indexed = index_.size();
  reply.coverage.segments_stored = index_.size() + segments_.size() + unreadable_.size();
  reply.coverage.routes_unseen =
      stored->total - std::min<std::uint64_t>(stored->total, index_.routes());
  return {};
}

exchange::CatalogReply ViewCatalog::Answer(const exchange::CatalogRequest& request,
                                           const AgentId& server) {
  exchange::CatalogReply reply;
  reply.server = server;
  reply.client = request.client;
  reply.request = request.request;
  if (auto filled = FillReply(reply, request.query); !filled) {
    reply.page = {};
    reply.places.clear();
    reply.error = filled.error().message;
  }
  return reply;
}

}  // namespace trailcast::catalog
