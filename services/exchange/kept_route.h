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

// This is a server's knowledge of one route: what is durable, what was announced, and what follows
// from the two.
class KeptRoute {
 public:
  using Time = std::chrono::steady_clock::time_point;

  // Takes what was found in the store. `stored` may be empty when segments came before their route.
  KeptRoute(std::optional<route::RouteInfo> stored, const std::vector<store::HeldSegment>& held,
            WantList::Options want);

  enum class ClaimResult : std::uint8_t {
    kNews,      // more is known than before
    kOldNews,   // nothing new
    kConflict,  // contradicts a complete route, or completes one with fewer segments than stored
    kDeleted,   // the revision was deleted, so nothing of it is wanted
  };
  // Notes that an agent announces the route. Segments that are not held are wanted from `ask_at`
  // on.
  ClaimResult Claim(const route::RouteInfo& info, Time ask_at);
  // Tells that some agent has announced it before.
  [[nodiscard]] bool heard() const { return heard_; }

  void MarkHeld(SegmentIndex index, const route::Digest& digest, Time now);
  // Notes that the segment's bytes on the disk are damaged. It is no longer held, and is asked for
  // from now on.
  void MarkDamaged(SegmentIndex index, Time now);
  [[nodiscard]] bool Holds(SegmentIndex index) const { return held_.contains(index); }
  [[nodiscard]] bool IsDamaged(SegmentIndex index) const { return damaged_.contains(index); }
  [[nodiscard]] std::vector<SegmentIndex> Damaged() const;
  // Returns the segment's digest, which is known of a damaged one too.
  [[nodiscard]] std::optional<route::Digest> DigestOf(SegmentIndex index) const;

  // Returns the route as far as it is durable: the claim if all of it is held, else the durable
  // prefix with length and bytes in proportion. It is empty if nothing is known or held yet.
  [[nodiscard]] std::optional<route::RouteInfo> DurableInfo() const;
  // Notes that the store has `info` with its labels, and perhaps more of the route than was claimed
  // here. With a tombstone nothing is held any more.
  void MarkStored(const route::RouteInfo& info);
  // Takes up what the store has, perhaps from another process. Missing segments are wanted from
  // `ask_at` on. Returns true if anything of it is new here.
  [[nodiscard]] bool TakeUp(const std::optional<route::RouteInfo>& stored,
                            const std::vector<store::HeldSegment>& held, Time now, Time ask_at);
  // Forgets a claim that does not fit the segments, so that it is never announced.
  void ForgetClaim();
  // Returns the agent that taught the route, if that is known.
  [[nodiscard]] std::optional<AgentId> scout() const;
  [[nodiscard]] const std::optional<route::RouteInfo>& stored() const { return stored_; }
  [[nodiscard]] bool complete() const {
    return stored_ && stored_->state == route::RouteState::kComplete;
  }

  [[nodiscard]] bool deleted() const {
    return stored_ && stored_->standing == route::Standing::kDeleted;
  }
  // These note that the store has no room for the revision, or has room again.
  void MarkFull(const std::string& reason) { full_ = reason; }
  void MarkRoom() {
    if (!over_until_) full_.clear();
  }
  // Notes that its scout is over a quota. Receipts tell the scout so until `until`.
  void MarkOver(const std::string& reason, Time until);
  // Adds a remark for the agent that teaches the route, which it reads while nothing is refused.
  void Remark(const std::string& text) {
    remark_ = text;
    receipt_due = true;
  }
  // Ends the note of MarkOver once its time has passed, and makes a receipt due that says so.
  void LapseOver(Time now);

  // Tells that a receipt would have something to say.
  [[nodiscard]] bool can_receipt() const {
    return holds_any() || complete() || deleted() || !full_.empty();
  }
  [[nodiscard]] bool holds_any() const { return !held_.empty(); }
  [[nodiscard]] Receipt MakeReceipt(const AgentId& server, const route::RouteKey& key);

  WantList want;
  // The keeper has these tasks for this route.
  bool receipt_due = false;
  bool announce_due = false;
  bool resend_due = false;  // announce although nothing changed, as after a start
  // Tells that nothing is left to do until an agent mentions the route again.
  [[nodiscard]] bool idle() const {
    return want.empty() && !receipt_due && !announce_due && !resend_due;
  }
  // Another server gave the route the number that it has, or that it was announced with; another
  // server has all of it.
  bool numbered_elsewhere = false;
  bool completed_elsewhere = false;
  Time spoken_of_at{};
  Time refreshed_at{};  // when the store was last looked at
  std::optional<Time> receipt_at;
  std::optional<Time> announced_at;

 private:
  // Wants those of the route's first `count` segments that are not held, from `ask_at` on.
  void WantMissing(std::uint32_t count, Time ask_at);
  void AdvancePrefix();
  // Returns ChainDigest of the prefix.
  [[nodiscard]] const route::Digest& PrefixDigest();

  std::optional<route::RouteInfo> stored_;
  std::optional<route::RouteInfo> claim_;
  bool heard_ = false;
  SegmentDigests held_;
  SegmentDigests damaged_;
  std::uint32_t prefix_ = 0;  // all segments below are held
  // This is ChainDigest of the first `chained_` segments. It is kept so that each segment is hashed
  // in once.
  std::uint32_t chained_ = 0;
  route::Digest chain_{};
  std::string remark_;              // for the agent that teaches it
  std::string full_;                // why the store takes nothing; empty while it does
  std::optional<Time> over_until_;  // set while a quota is the reason
};

}  // namespace trailcast::exchange
