#pragma once

#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "services/base/told_lately.h"
#include "services/exchange/answer_queue.h"
#include "services/exchange/integrity.h"
#include "services/exchange/kept_route.h"
#include "services/exchange/messages.h"
#include "services/exchange/missing_routes.h"
#include "services/exchange/servers_there.h"
#include "services/exchange/stand_in.h"
#include "services/store/route_store.h"

namespace trailcast::exchange {

struct RouteKeeperOptions {
  WantList::Options want{};
  std::chrono::milliseconds fresh_grace{200};  // as in RouteFetcherOptions
  // What a route has grown by since it was heard of was written to this keeper too: a reliable
  // writer brings it, in its own time after an outage. Asked for sooner it goes over the air twice.
  std::chrono::milliseconds grown_grace{1000};
  AnswerQueue::Options answers{};
  std::chrono::milliseconds announce_every{250};     // at most so often while a route grows
  std::chrono::milliseconds announced_together{50};  // those due within so long: one commit
  std::chrono::milliseconds receipt_again{500};      // at most so often when nothing new is durable
  std::chrono::milliseconds note_again{10'000};     // the same trouble is reported at most so often
  std::chrono::milliseconds over_quota_told{5000};  // after the last of it was refused
  std::chrono::milliseconds refresh_again{1000};  // the store is looked at again for another's work
  // A slow link holds the caller up for so much, and nothing is received meanwhile.
  std::size_t answer_bytes_per_tick = 128U << 10U;
  // Routes that the keeper has at hand; the others are in the store alone, and are taken up when
  // somebody speaks of them. A full one lays aside what nobody spoke of for `laid_aside_after`.
  std::size_t most_at_hand = 1024;
  std::chrono::milliseconds laid_aside_after{10'000};
  // The newest of the stored routes: taken up and announced at the first Tick.
  std::uint32_t announced_at_start = 256;
};

// For the owner's log.
struct Note {
  enum class Severity : std::uint8_t { kInfo, kWarning, kError };
  Severity severity = Severity::kInfo;
  std::string text;
};

struct KeeperCounters {
  std::uint64_t appended = 0;  // pieces made durable
  std::uint64_t appended_bytes = 0;
  std::uint64_t duplicates = 0;   // pieces held already
  std::uint64_t corrupt = 0;      // pieces that failed their digest: dropped, asked for again
  std::uint64_t conflicting = 0;  // pieces or announcements that contradict what is held: dropped
  std::uint64_t unproven = 0;     // pieces lent that could be anything: dropped
  std::uint64_t store_failures = 0;
  std::uint64_t damaged = 0;   // segments found damaged in the store: asked for again
  std::uint64_t repaired = 0;  // of these, those that somebody had
  std::uint64_t answered = 0;  // pieces sent to whoever asked
  std::uint64_t answered_bytes = 0;
  std::uint64_t receipts = 0;  // sent
};

// The server's end of the protocol for all routes: makes durable what arrives, says so only then,
// asks for what it lacks, answers who asks. No clock, no socket: messages in, messages out; the
// store is its only effect. Other servers may share the store: what they put there counts as held
// here, and of what all hear alike, as an edit or a request, it lets one do it. Handle everything
// one Take returned, then Tick: the pieces of one Take are one commit.
class RouteKeeper {
 public:
  using Time = std::chrono::steady_clock::time_point;
  // What the owner answers from the same store.
  struct Catalog {
    std::function<CatalogReply(const CatalogRequest&)> answer{};
    // The revisions that an edit changes, as they are afterwards; writes nothing.
    std::function<Result<std::vector<route::RouteInfo>>(const route::RouteEdit&)> plan{};
  };

  // `store` outlives the keeper. Takes no longer with a million routes in it.
  [[nodiscard]] static Result<std::unique_ptr<RouteKeeper>> Open(AgentId self,
                                                                 store::RouteStore& store,
                                                                 Catalog catalog,
                                                                 Integrity integrity,
                                                                 RouteKeeperOptions options = {});

  void Handle(Message message, Time now);
  [[nodiscard]] std::vector<Message> Tick(Time now);
  // Of what Tick returned: handed over, or not, because the link is blocked; then it is returned
  // again by a later Tick.
  void Sent(const Message& message);
  void NotSent(const Message& message, Time now);

  // The owner takes nothing, or not all, of the revision for now: its scout is told why.
  void TellOverQuota(const route::RouteKey& key, const std::string& why, Time now);
  // Who teaches the revision reads it in its receipts until another one is made.
  void Remark(const route::RouteKey& key, const std::string& text, Time now);

  // Stores later labels of revisions, in one commit, and has them announced.
  [[nodiscard]] Result<void> Relabel(std::span<const route::RouteInfo> infos, Time now);
  // Reading the segment found it damaged: it is asked for, of any holder.
  void NoteDamage(const route::RouteKey& key, SegmentIndex index, Time now);
  // The stored route lacks segments: it is taken up, which has them asked for.
  void Attend(const route::RouteKey& key, Time now) { (void)Find(key, now, Which::kStored); }
  // Drops the segments of a teaching that nobody announced. False if somebody has by now.
  [[nodiscard]] Result<bool> DropStray(const route::RouteKey& key);
  // Segments stored since the last call, repaired ones among them.
  [[nodiscard]] std::vector<route::SegmentPiece> TakeAppended();
  // Segments found damaged since the last call.
  [[nodiscard]] std::vector<std::pair<route::RouteKey, SegmentIndex>> TakeDamaged();
  // Somebody waits for segments: Tick soon.
  [[nodiscard]] bool answering() const { return !answers_.empty(); }
  // The last Tick did not send all that it could have.
  [[nodiscard]] bool AnswersDue(Time now) const { return answers_.IsDue(now); }

  [[nodiscard]] std::vector<Note> TakeNotes();
  [[nodiscard]] const KeeperCounters& counters() const { return counters_; }
  // Segments that were announced and are not durable here.
  [[nodiscard]] std::size_t backlog() const;
  // Why the store did not take what was last given to it, its disk being full for example; empty:
  // it did.
  [[nodiscard]] const std::string& untaken() const {
    return segments_untaken_.empty() ? routes_untaken_ : segments_untaken_;
  }

 private:
  RouteKeeper(AgentId self, store::RouteStore& store, Catalog catalog, Integrity integrity,
              RouteKeeperOptions options);

  void HandleAnnouncement(const RouteAnnouncement& announcement, Time now);
  void HandleBatch(SegmentBatch& batch, Time now);  // its pieces are moved away
  void HandleRequest(const SegmentRequest& request, Time now);
  [[nodiscard]] bool IsLent(const SegmentBatch& batch, const route::RouteKey& key, Time now);
  [[nodiscard]] bool IsKnown(const route::SegmentPiece& piece, Time now);
  void TakeFromOthers(const route::SegmentPiece& named, Time now);
  void TellDigests(const route::RouteKey& key, const KeptRoute& kept,
                   const std::vector<SegmentIndex>& indices);
  // Nothing more of it is to be had.
  [[nodiscard]] bool IsSettled(const route::RouteKey& key);
  void HandleCatalogRequest(const CatalogRequest& request);
  void HandleEdit(const RouteEditRequest& request, Time now);
  // Carries the edit out, unless some server did: its answer, to be read by TakeUpEdit.
  [[nodiscard]] Result<std::string> EditOnce(const RouteEditRequest& request, Time now);
  [[nodiscard]] Result<std::string> Edit(const route::RouteEdit& edit);
  // The store has these labels: has them announced.
  void TellRelabelled(const route::RouteInfo& info, Time now);
  // Has what was changed announced; the revisions as they are now.
  [[nodiscard]] Result<std::vector<route::RouteInfo>> TakeUpEdit(const std::string& answer,
                                                                 Time now);

  // The route's state, taken up from the store if need be; null (and a note) if that fails, or for
  // a route of which the store has nothing when only stored ones are asked for.
  enum class Which : std::uint8_t { kAny, kStored };
  KeptRoute* Find(const route::RouteKey& key, Time now, Which which = Which::kAny);
  [[nodiscard]] bool MakeRoom(Time now);
  // Takes up what another server may have stored; not when that was just done.
  void Refresh(const route::RouteKey& key, KeptRoute& kept, Time now);
  // What is due to be asked for.
  [[nodiscard]] std::vector<SegmentIndex> Lacking(const route::RouteKey& key, KeptRoute& kept,
                                                  Time now);

  [[nodiscard]] bool IsNew(const route::SegmentPiece& piece, Time now);
  void MarkAppended(route::SegmentPiece& piece, Time now);  // it is moved away
  void Commit(Time now);
  void Append(std::span<route::SegmentPiece> pieces, Time now);
  void TellFull(std::span<const route::SegmentPiece> pieces, const Error& error);
  void Refuse(const Error& error, const route::RouteKey& key, Time now);
  // True if the announced manifest is that of the segments held.
  [[nodiscard]] bool ManifestIsRight(const route::RouteInfo& info, const KeptRoute& kept, Time now);
  // Stores what has become durable of routes' infos, in one commit, and announces it.
  void Announce(Time now, std::vector<Message>& out);
  // What is to be announced of the route now, if anything; `grown_too`: also of one that has been
  // announced before.
  [[nodiscard]] std::optional<route::RouteInfo> News(KeptRoute& kept, Time now, bool grown_too);
  // The revision of this one's route that is active; 0: none.
  [[nodiscard]] RevisionNumber Followed(const route::RouteInfo& info);
  // A route's first complete revision is the active one, unless it is held back, or another server
  // had it before.
  [[nodiscard]] Result<void> ActivateFirst(std::vector<route::RouteInfo>& completing);
  [[nodiscard]] Result<void> Put(std::span<const route::RouteInfo> infos, bool completing,
                                 Time now);
  [[nodiscard]] Result<void> PutTogether(std::vector<route::RouteInfo> infos, bool completing,
                                         std::vector<route::RouteInfo>& reconciled);
  void StoreInfos(std::span<const route::RouteInfo> infos, bool completing, Time now,
                  std::vector<route::RouteKey>& stored);
  void MarkStored(const route::RouteInfo& info, Time now, std::vector<route::RouteKey>& stored);
  void TellComplete(const route::RouteKey& key, Time now);
  void SendAnswers(Time now, std::vector<Message>& out);
  void AddNote(Note::Severity severity, const std::string& about, std::string text, Time now);

  AgentId self_;
  store::RouteStore& store_;
  Catalog catalog_;
  Integrity integrity_;
  RouteKeeperOptions options_;

  std::map<route::RouteKey, KeptRoute> routes_;
  std::vector<route::SegmentPiece> arrived_;   // since the last Tick
  std::vector<route::SegmentPiece> appended_;  // that nobody was told of yet
  std::vector<Message> replies_;               // to the catalog's clients; digests
  Time grown_due_{};                           // when infos of routes that grow are stored again
  std::vector<std::pair<route::RouteKey, SegmentIndex>> damaged_;  // that nobody was told of yet
  AnswerQueue answers_;
  StandIn stand_in_;
  ServersThere servers_;  // others
  MissingRoutes missing_;
  // Apart, since there may be room for the one when there is none for the other.
  std::string segments_untaken_;
  std::string routes_untaken_;
  std::vector<Note> notes_;
  ToldLately noted_{options_.note_again};
  KeeperCounters counters_;
};

}  // namespace trailcast::exchange
