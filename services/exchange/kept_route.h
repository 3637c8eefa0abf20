#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "services/exchange/messages.h"
#include "services/exchange/segment_digests.h"
#include "services/exchange/want_list.h"
#include "services/store/route_store.h"

namespace trailcast::exchange {

// What a server knows of one route: what is durable, what was announced, what follows from the two.
class KeptRoute {
 public:
  using Time = std::chrono::steady_clock::time_point;

  // As found in the store: `stored` may be empty when segments came before their route.
  KeptRoute(std::optional<route::RouteInfo> stored, const std::vector<store::HeldSegment>& held,
            WantList::Options want);

  enum class ClaimResult : std::uint8_t {
    kNews,      // more is known than before
    kOldNews,   // nothing new
    kConflict,  // contradicts a complete route, or completes one with fewer segments than stored
    kDeleted,   // the revision was deleted: nothing of it is wanted
  };
  // Somebody announces the route. Segments that are not held are wanted from `ask_at` on.
  ClaimResult Claim(const route::RouteInfo& info, Time ask_at);
  // Somebody announced it before.
  [[nodiscard]] bool heard() const { return heard_; }

  void MarkHeld(SegmentIndex index, const route::Digest& digest, Time now);
  // Its bytes on the disk are not what they were: no longer held, and asked for from now on.
  void MarkDamaged(SegmentIndex index, Time now);
  [[nodiscard]] bool Holds(SegmentIndex index) const { return held_.contains(index); }
  [[nodiscard]] bool IsDamaged(SegmentIndex index) const { return damaged_.contains(index); }
  [[nodiscard]] std::vector<SegmentIndex> Damaged() const;
  // What the segment is, or was before it was damaged.
  [[nodiscard]] std::optional<route::Digest> DigestOf(SegmentIndex index) const;

  // The route as far as it is durable: the claim if all of it is held, else the durable prefix with
  // length and bytes in proportion. Empty if nothing can be said, or nothing is held yet.
  [[nodiscard]] std::optional<route::RouteInfo> DurableInfo() const;
  // The store has `info`, its labels included, and perhaps more of it than was claimed here; with a
  // tombstone nothing is held any more.
  void MarkStored(const route::RouteInfo& info);
  // The store has this, perhaps from another process. Segments that nobody stored are wanted from
  // `ask_at` on. True if anything of it is new here.
  [[nodiscard]] bool TakeUp(const std::optional<route::RouteInfo>& stored,
                            const std::vector<store::HeldSegment>& held, Time now, Time ask_at);
  // The claim does not fit the segments: forget it, and never announce it.
  void ForgetClaim();
  // Who taught it, as far as that is known.
  [[nodiscard]] std::optional<AgentId> scout() const;
  [[nodiscard]] const std::optional<route::RouteInfo>& stored() const { return stored_; }
  [[nodiscard]] bool complete() const {
    return stored_ && stored_->state == route::RouteState::kComplete;
  }

  [[nodiscard]] bool deleted() const {
    return stored_ && stored_->standing == route::Standing::kDeleted;
  }
  // The store has no room for the revision, or has again.
  void MarkFull(const std::string& reason) { full_ = reason; }
  void MarkRoom() {
    if (!over_until_) full_.clear();
  }
  // Its scout is over a quota, and is told so until then.
  void MarkOver(const std::string& reason, Time until);
  // Worth knowing for who teaches it, while nothing is refused.
  void Remark(const std::string& text) {
    remark_ = text;
    receipt_due = true;
  }
  // That time has passed: a receipt is due that says so.
  void LapseOver(Time now);

  // There is something that a receipt could say.
  [[nodiscard]] bool can_receipt() const {
    return holds_any() || complete() || deleted() || !full_.empty();
  }
  [[nodiscard]] bool holds_any() const { return !held_.empty(); }
  [[nodiscard]] Receipt MakeReceipt(const AgentId& server, const route::RouteKey& key);

  WantList want;
  // What the keeper has to do for this route.
  bool receipt_due = false;
  bool announce_due = false;
  bool resend_due = false;  // announce although nothing changed, as after a start
  // Nothing is left to do, unless somebody speaks of it again.
  [[nodiscard]] bool idle() const {
    return want.empty() && !receipt_due && !announce_due && !resend_due;
  }
  // Another server has given it the number that it has, or was announced with; has all of it.
  bool numbered_elsewhere = false;
  bool completed_elsewhere = false;
  Time spoken_of_at{};
  Time refreshed_at{};  // when the store was last looked at
  std::optional<Time> receipt_at;
  std::optional<Time> announced_at;

 private:
  // Of the route's first `count` segments those that are not held, from `ask_at` on.
  void WantMissing(std::uint32_t count, Time ask_at);
  void AdvancePrefix();
  // ChainDigest of the prefix.
  [[nodiscard]] const route::Digest& PrefixDigest();

  std::optional<route::RouteInfo> stored_;
  std::optional<route::RouteInfo> claim_;
  bool heard_ = false;
  SegmentDigests held_;
  SegmentDigests damaged_;
  std::uint32_t prefix_ = 0;  // all below are held
  // ChainDigest of the first `chained_` segments, kept so that each is hashed in once.
  std::uint32_t chained_ = 0;
  route::Digest chain_{};
  std::string remark_;              // for who teaches it
  std::string full_;                // why the store takes nothing; empty: it does
  std::optional<Time> over_until_;  // that is a quota, told of until then
};

}  // namespace trailcast::exchange
