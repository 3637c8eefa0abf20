#pragma once

#include <chrono>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include "services/exchange/integrity.h"
#include "services/exchange/messages.h"
#include "services/exchange/want_list.h"

namespace trailcast::exchange {

struct RouteFetcherOptions {
  WantList::Options want{};
  // The newest segments of a route that is being taught are probably on their way, so they are not
  // asked for before this has passed.
  std::chrono::milliseconds fresh_grace{200};
  // This is above the scout's announce_every, so that a scout in range never counts as absent.
  // After so long a silence the fetcher asks who has the route, and again each time it has passed.
  std::chrono::milliseconds quiet_after{5000};
  // A reader that has just begun to listen to a route is not sent its segments yet, and nothing
  // tells when it is. So while none came, or none for `silent_after`, the fetcher asks this often
  // for the digest of one that it lacks, until something comes. After `knock_for` it goes on
  // without.
  std::chrono::milliseconds knock_every{100};
  std::chrono::milliseconds knock_for{1000};
  std::chrono::milliseconds silent_after{1000};
  // Returns bytes with this digest that the owner has already, from other revisions of the route.
  // If set, digests are asked for first, and bytes only of what is new.
  std::function<std::optional<route::Bytes>(const route::Digest&)> own_content{};
  // Memory keeps what followers lend until all of it is there and proven. This bounds it.
  std::size_t most_borrowed_bytes = 64U << 20U;
};

enum class FetchState : std::uint8_t {
  kWaiting = 0,   // no holder of the route is heard; see waiting_since
  kFetching = 1,  // segments are missing and under way
  kUpToDate = 2,  // all that is known is held, and the route is still being taught
  kComplete = 3,  // the whole route is held, and its manifest digest is right
  kWrong = 4,     // the pieces do not make up the announced manifest: not to be replayed
};

struct FetchProgress {
  FetchState state = FetchState::kWaiting;
  std::uint32_t held = 0;
  std::uint32_t known = 0;                                             // segments announced
  std::optional<std::chrono::steady_clock::time_point> waiting_since;  // set only in kWaiting
  std::uint64_t bad_pieces = 0;  // pieces that failed their digest; dropped, and asked for again
  std::uint64_t duplicate_pieces = 0;  // pieces that were held already
  std::uint64_t conflicting = 0;  // pieces or announcements that contradict what is held; dropped
};

// This is the follower's end of the protocol for one route. It has no clock and no I/O: messages go
// in, messages and verified pieces come out. It tolerates loss, duplicates, any order, damage, and
// holders that come and go.
class RouteFetcher {
 public:
  using Time = std::chrono::steady_clock::time_point;

  struct Held {
    SegmentIndex index;
    route::Digest digest;
  };

  // `held` is what the owner's store already has of this route, as read and so verified.
  RouteFetcher(AgentId self, route::RouteKey key, const std::vector<Held>& held,
               Integrity integrity, Time now, RouteFetcherOptions options = {});

  // Learns what a catalog reply said of the route. An announcement does the same.
  void Learn(const route::RouteInfo& info, Time now);

  void Handle(Message message, Time now);
  [[nodiscard]] std::vector<Message> Tick(Time now);

  // Returns verified pieces that are new since the last call, in the order of their arrival.
  [[nodiscard]] std::vector<route::SegmentPiece> TakeArrived();

  // Returns the lowest segment that is announced and not held.
  [[nodiscard]] std::optional<SegmentIndex> NextMissing() const { return want_.first(); }
  [[nodiscard]] FetchProgress Progress(Time now) const;
  [[nodiscard]] bool Complete() const { return verdict_ == FetchState::kComplete; }
  // Returns the agents that sent pieces which were new here.
  [[nodiscard]] const std::set<AgentId>& senders() const { return senders_; }
  // Tells that a holder said that the revision was deleted, so that what is missing will not come.
  [[nodiscard]] bool deleted() const { return deleted_; }
  // Returns the best announcement so far.
  [[nodiscard]] const std::optional<route::RouteInfo>& info() const { return info_; }

 private:
  void HandleBatch(SegmentBatch& batch, Time now);  // its pieces are moved away
  void Accept(route::SegmentPiece piece, Time now);
  void Borrow(route::SegmentPiece piece, Time now);
  void ReturnBorrowed(Time now);
  void TakeFromOwn(const route::SegmentPiece& named, Time now);
  void Ask(const std::vector<SegmentIndex>& lacking, bool digests_only,
           std::vector<Message>& messages) const;
  void WantMissing(Time ask_at);
  void Judge(Time now);
  [[nodiscard]] bool IsInquiryDue(Time now);
  // Tells that segments may not be asked for yet, and adds the message to knock with.
  [[nodiscard]] bool Knocks(Time now, std::vector<Message>& messages);

  AgentId self_;
  route::RouteKey key_;
  Integrity integrity_;
  RouteFetcherOptions options_;

  std::optional<route::RouteInfo> info_;
  std::map<SegmentIndex, route::Digest> held_;
  WantList want_;
  std::vector<route::SegmentPiece> arrived_;
  // A follower lent these. It may be mistaken or lie, so they are not given out before the manifest
  // of the complete route proves them all.
  std::map<SegmentIndex, route::SegmentPiece> borrowed_;
  std::size_t borrowed_bytes_ = 0;
  bool borrows_ = true;  // false once they proved wrong: a liar would keep it busy for ever
  std::set<SegmentIndex> asked_digest_;  // segments whose digest was asked for: now the bytes are
  std::optional<FetchState> verdict_;    // kComplete or kWrong, once all is held
  Time heard_at_;    // when a holder of this route was last heard; at first the creation
  Time inquire_at_;  // when to ask who has it
  std::optional<Time> came_at_;  // when the last of its segments or digests came
  std::optional<Time> knocking_since_;
  Time knock_at_{};
  bool deleted_ = false;
  std::set<AgentId> senders_;
  FetchProgress counts_;
};

}  // namespace trailcast::exchange
