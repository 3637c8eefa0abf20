#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "services/base/result.h"
#include "services/exchange/answer_queue.h"
#include "services/exchange/messages.h"
#include "services/exchange/segment_digests.h"

namespace trailcast::exchange {

struct RouteSenderOptions {
  // Servers answer each announcement with what they have and what they lack. So this also bounds
  // how soon a returning server, or a scout that returns into radio range, goes on.
  std::chrono::milliseconds announce_every{2000};
  AnswerQueue::Options answers{};
  std::size_t answer_bytes_per_tick = 512U << 10U;  // so that one Tick never floods a radio link
};

// This is a revision's lifecycle state at a server, and the revision of its route that robots
// follow there, if any.
struct StandingThere {
  route::Standing standing = route::Standing::kStaged;
  RevisionNumber followed{};  // 0 if there is none
};

// This is the scout's end of the protocol for one route. It announces, streams, answers, and counts
// what some server has acknowledged. It has no clock and no I/O: messages go in, messages come out.
// The owner stores each piece before Add, and publishes what Tick returns.
class RouteSender {
 public:
  using Time = std::chrono::steady_clock::time_point;
  // Reads from the owner's store.
  using ReadPiece = std::function<Result<route::SegmentPiece>(SegmentIndex)>;

  // `held` and `receipted` come from the store after a restart, and are empty for a new route.
  RouteSender(AgentId self, route::RouteInfo info, ReadPiece read, SegmentDigests held,
              const std::vector<SegmentIndex>& receipted, RouteSenderOptions options = {});

  // Adds a segment that was taught and stored; `info` counts it. The next Tick streams it. A piece
  // without bytes stands for one whose bytes were taught before, so that servers have them.
  void Add(route::SegmentPiece piece, route::RouteInfo info);
  // Takes a change of the route without a new segment: it is complete.
  void Update(route::RouteInfo info);

  void Handle(const Message& message, Time now);
  [[nodiscard]] std::vector<Message> Tick(Time now);
  // Notes that a message of Tick could not be handed over. A later Tick returns it again.
  void NotSent(const Message& message, Time now);

  // Returns the info with the number that a server gave it since the last call, if one did, for
  // RouteStore::PutRoute.
  [[nodiscard]] std::optional<route::RouteInfo> TakeNumbered();
  // Returns segments acknowledged since the last call, for RouteStore::MarkReceipted.
  [[nodiscard]] std::vector<SegmentIndex> TakeNewlyReceipted();
  // Returns errors since the last call, from pieces that had to be sent and could not be read.
  [[nodiscard]] std::vector<Error> TakeReadErrors();

  // Returns the segments that no server has acknowledged, rising.
  [[nodiscard]] const std::set<SegmentIndex>& Unreceipted() const { return unreceipted_; }
  // Tells that the route is complete, and that a server has all of it on disk, with its final info.
  [[nodiscard]] bool AllReceipted() const;
  // Tells that nothing is left to send: all is acknowledged, or an operator deleted the revision.
  [[nodiscard]] bool Done() const { return AllReceipted() || deleted(); }
  // Returns the last receipt if it was a refusal.
  [[nodiscard]] const std::optional<Receipt>& refused() const { return refused_; }
  // Returns the remark of the last receipt that was no refusal, or nothing.
  [[nodiscard]] const std::string& remark() const { return remark_; }
  // Tells that an operator deleted the revision, so that no server wants it.
  [[nodiscard]] bool deleted() const { return refused_ && refused_->refusal == Refusal::kDeleted; }
  // Returns what the last receipt says.
  [[nodiscard]] const std::optional<StandingThere>& standing() const { return standing_; }
  // Returns a server whose receipt names other bytes under this teaching than those held here. It
  // has acknowledged nothing of these.
  [[nodiscard]] const std::optional<AgentId>& contradicted_by() const { return contradicted_by_; }
  [[nodiscard]] const route::RouteInfo& info() const { return info_; }

 private:
  void HandleRequest(const SegmentRequest& request, Time now);
  void TellDigests(const std::vector<SegmentIndex>& indices);
  void HandleReceipt(const Receipt& receipt);
  void MarkReceipted(SegmentIndex index);
  // Returns ChainDigest of the first `count` segments, or nothing while one of them is not known
  // here.
  [[nodiscard]] std::optional<route::Digest> PrefixDigest(std::uint32_t count);

  AgentId self_;
  route::RouteInfo info_;
  ReadPiece read_;
  RouteSenderOptions options_;

  SegmentDigests digests_;
  std::vector<route::Digest> chain_{route::Digest{}};  // [i]: ChainDigest of the first i segments
  std::set<SegmentIndex> unreceipted_;
  std::optional<AgentId> contradicted_by_;
  bool numbered_ = false;
  std::optional<StandingThere> standing_;
  bool complete_receipted_ = false;
  std::optional<Receipt> refused_;
  std::string remark_;
  std::vector<SegmentIndex> newly_receipted_;
  std::vector<Error> read_errors_;

  std::vector<route::SegmentPiece> to_stream_;
  AnswerQueue answers_;
  // These were asked for once, and a server has them. The server answers, unless the same agent
  // asks again.
  std::set<std::pair<AgentId, SegmentIndex>> left_to_server_;
  bool changed_ = true;
  std::optional<Time> announced_at_;
};

}  // namespace trailcast::exchange
