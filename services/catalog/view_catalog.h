#pragma once

#include <cstddef>
#include <deque>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "services/exchange/messages.h"
#include "services/store/route_store.h"
#include "services/view/any_camera.h"
#include "services/view/view_index.h"
#include "services/view/view_match.h"

namespace trailcast::catalog {

// Answers which routes, and which places on them, show what a camera sees now. It keeps an index of
// the stored segments in memory and fills it bit by bit, the newest routes first, and newly taught
// ones before them. A reply tells how much of the store it covers. It is not thread-safe.
class ViewCatalog {
 public:
  // `store` must outlive the catalog.
  explicit ViewCatalog(store::RouteStore& store, const view::ViewIndexOptions& options = {});

  // Indexes up to `most` more segments, or looks at so many routes. An error is the store's. A
  // segment that cannot be read is left out and reported once, or left for later if the store is
  // kUnavailable.
  [[nodiscard]] Result<void> Fill(std::size_t most);
  // Returns true if there is nothing to do at present: everything is indexed, or the index is full.
  [[nodiscard]] bool Filled() const;

  // Notes that more of this route was stored, without telling which segments.
  void Note(const route::RouteKey& key);
  // Indexes a segment that was stored or repaired. kCorrupt means that it is left out because its
  // bytes cannot be decoded.
  [[nodiscard]] Result<void> Add(const route::SegmentPiece& piece);
  // Returns the segments whose damage was found since the last call, by filling or by answering.
  [[nodiscard]] std::vector<view::ViewIndex::Place> TakeDamaged();
  // Drops a route that has left the store.
  void Forget(const route::RouteKey& key);

  // Answers a request that has a view. It never fails; the reply's `error` tells what went wrong.
  [[nodiscard]] exchange::CatalogReply Answer(const exchange::CatalogRequest& request,
                                              const AgentId& server);

  [[nodiscard]] const view::ViewIndex& index() const { return index_; }
  [[nodiscard]] view::ViewIndex& index() { return index_; }  // for queries

 private:
  using Place = view::ViewIndex::Place;
  using Matcher = std::function<view::ViewMatch(const route::Segment&)>;

  [[nodiscard]] Result<void> FillOne();
  [[nodiscard]] Result<void> ReadPage();
  [[nodiscard]] Result<void> LookAt(const route::RouteKey& key);
  [[nodiscard]] Result<void> IndexNext();
  [[nodiscard]] Result<void> Index(const Place& place, const Result<route::Segment>& segment);
  [[nodiscard]] Result<route::Segment> Read(const Place& place);
  [[nodiscard]] Result<std::optional<route::FoundPlace>> Compare(const Place& place,
                                                                 const Matcher& matcher);
  [[nodiscard]] Result<std::vector<route::FoundPlace>> FindBy(const std::vector<Place>& candidates,
                                                              const Matcher& matcher);
  [[nodiscard]] Result<void> LookAround(std::vector<route::FoundPlace>& found,
                                        const Matcher& matcher);
  [[nodiscard]] Result<std::vector<route::FoundPlace>> Find(const route::View& seen);
  [[nodiscard]] Result<void> FillReply(exchange::CatalogReply& reply,
                                       const route::RouteQuery& query);

  store::RouteStore& store_;
  view::ViewIndex index_;
  std::string cursor_;                // how far the walk through the store is
  bool walked_ = false;               // the walk has reached the end
  std::deque<route::RouteKey> page_;  // the walk's next routes to look at
  std::set<route::RouteKey> noted_;   // routes to look at before those
  std::deque<Place> segments_;        // segments to index, of routes looked at
  std::set<Place> unreadable_;
  std::vector<Place> damaged_;  // not reported yet
};

}  // namespace trailcast::catalog
