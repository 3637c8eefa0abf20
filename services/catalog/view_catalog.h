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

// "Which routes, and where on them, show what I see now?" Keeps an index of the stored segments in
// memory, filled bit by bit, the newest routes first, and what is taught meanwhile before them; a
// reply says how much of the stock it covers. Not thread-safe.
class ViewCatalog {
 public:
  // `store` outlives the catalog.
  explicit ViewCatalog(store::RouteStore& store, const view::ViewIndexOptions& options = {});

  // Indexes up to `most` segments more, or looks at so many routes. An error is the store's; what
  // could not be read is left out and told once, or left for later when the store is kUnavailable.
  [[nodiscard]] Result<void> Fill(std::size_t most);
  // Nothing to do at present: all is indexed, or the index is full.
  [[nodiscard]] bool Filled() const;

  // More of this route has been stored, nobody knows which segments.
  void Note(const route::RouteKey& key);
  // Indexes a segment that has been stored, or repaired. kCorrupt if it is left out because its
  // bytes mean nothing.
  [[nodiscard]] Result<void> Add(const route::SegmentPiece& piece);
  // Segments that could not be read, for their damage, since the last call: in filling, or for an
  // answer.
  [[nodiscard]] std::vector<view::ViewIndex::Place> TakeDamaged();
  // The route is there no more.
  void Forget(const route::RouteKey& key);

  // Answers a request that has a view. Never fails: what went wrong is in the reply's `error`.
  [[nodiscard]] exchange::CatalogReply Answer(const exchange::CatalogRequest& request,
                                              const AgentId& server);

  [[nodiscard]] const view::ViewIndex& index() const { return index_; }
  [[nodiscard]] view::ViewIndex& index() { return index_; }  // to be asked

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
  std::string cursor_;                // of the walk through the store
  bool walked_ = false;               // to its end
  std::deque<route::RouteKey> page_;  // of the walk: to be looked at
  std::set<route::RouteKey> noted_;   // to be looked at before
  std::deque<Place> segments_;        // of the routes looked at: to be indexed
  std::set<Place> unreadable_;
  std::vector<Place> damaged_;  // that nobody was told of yet
};

}  // namespace trailcast::catalog
