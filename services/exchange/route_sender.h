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
  // Servers answer each announcement with what they have and what they lack, so this is also how
  // soon a returning server, or a scout returning into radio range, goes on.
  std::chrono::milliseconds announce_every{2000};
  AnswerQueue::Options answers{};
  std::size_t answer_bytes_per_tick = 512U << 10U;  // so that one Tick never floods a radio link
};

// What a revision is to a server's operators, and which of its route robots follow there, if any.
struct StandingThere {
  route::Standing standing = route::Standing::kStaged;
  RevisionNumber followed{};  // 0: none
};

// The scout's end of the protocol for one route: announces, streams, answers, and keeps count of
// what some server has confirmed. No clock, no I/O: messages in, messages out. The owner stores
// each piece before Add, and publishes what Tick returns.
class RouteSender {
 public:
  using Time = std::chrono::steady_clock::time_point;
  // Reads from the owner's store.
  using ReadPiece = std::function<Result<route::SegmentPiece>(SegmentIndex)>;

  // `held` and `receipted` are from the store after a restart, and empty for a new route.
  RouteSender(AgentId self, route::RouteInfo info, ReadPiece read, SegmentDigests held,
              const std::vector<SegmentIndex>& receipted, RouteSenderOptions options = {});

  // A segment was taught and stored; `info` counts it. Streamed at the next Tick, without its bytes
  // if it has none here: for one whose bytes were taught before, so that servers have them.
  void Add(route::SegmentPiece piece, route::RouteInfo info);
  // The route changed without a new segment: complete.
  void Update(route::RouteInfo info);

  void Handle(const Message& message, Time now);
  [[nodiscard]] std::vector<Message> Tick(Time now);
  // Of what Tick returned, this could not be handed over: a later Tick returns it again.
  void NotSent(const Message& message, Time now);

  // With the number that a server gave it, if it did since the last call: for RouteStore::PutRoute.
  [[nodiscard]] std::optional<route::RouteInfo> TakeNumbered();
  // Receipted since the last call: for RouteStore::MarkReceipted.
  [[nodiscard]] std::vector<SegmentIndex> TakeNewlyReceipted();
  // Pieces that were to be sent but could not be read, since the last call.
  [[nodiscard]] std::vector<Error> TakeReadErrors();

  // Segments that no server has confirmed, rising.
  [[nodiscard]] const std::set<SegmentIndex>& Unreceipted() const { return unreceipted_; }
  // The route is complete, and a server has all of it on disk: segments and final info.
  [[nodiscard]] bool AllReceipted() const;
  // Nothing is left to be sent: all is receipted, or an operator deleted the revision.
  [[nodiscard]] bool Done() const { return AllReceipted() || deleted(); }
  // The last receipt, if it was a refusal.
  [[nodiscard]] const std::optional<Receipt>& refused() const { return refused_; }
  // What the last receipt that was none has for people, or nothing.
  [[nodiscard]] const std::string& remark() const { return remark_; }
  // An operator deleted the revision: nobody wants it.
  [[nodiscard]] bool deleted() const { return refused_ && refused_->refusal == Refusal::kDeleted; }
  // As the last receipt has it.
  [[nodiscard]] const std::optional<StandingThere>& standing() const { return standing_; }
  // A server whose receipt names other bytes under this teaching than those held here; nothing of
  // these counts as receipted by it.
  [[nodiscard]] const std::optional<AgentId>& contradicted_by() const { return contradicted_by_; }
  [[nodiscard]] const route::RouteInfo& info() const { return info_; }

 private:
  void HandleRequest(const SegmentRequest& request, Time now);
  void TellDigests(const std::vector<SegmentIndex>& indices);
  void HandleReceipt(const Receipt& receipt);
  void MarkReceipted(SegmentIndex index);
  // ChainDigest of the first `count` segments; nothing while one of them is not known here.
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
  // Asked once for what a server has: left to the server, unless the same agent asks again.
  std::set<std::pair<AgentId, SegmentIndex>> left_to_server_;
  bool changed_ = true;
  std::optional<Time> announced_at_;
};

}  // namespace trailcast::exchange
