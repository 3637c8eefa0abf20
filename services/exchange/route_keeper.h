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
#include "services/exchange/backup_responder.h"
#include "services/exchange/integrity.h"
#include "services/exchange/kept_route.h"
#include "services/exchange/messages.h"
#include "services/exchange/missing_routes.h"
#include "services/exchange/servers_there.h"
#include "services/store/route_store.h"

namespace trailcast::exchange {

struct RouteKeeperOptions {
  WantList::Options want{};
  std::chrono::milliseconds fresh_grace{200};  // as in RouteFetcherOptions
  // The segments that a route has grown by since it was heard of were written to this keeper too,
  // and a reliable writer brings them in its own time after an outage. Asking sooner would send
  // them over the air twice.
  std::chrono::milliseconds grown_grace{1000};
  AnswerQueue::Options answers{};
  std::chrono::milliseconds announce_every{250};     // while a route grows
  std::chrono::milliseconds announced_together{50};  // all due within so long share one commit
  std::chrono::milliseconds receipt_again{500};      // while nothing new is durable
  std::chrono::milliseconds note_again{10'000};      // between reports of the same trouble
  std::chrono::milliseconds over_quota_told{5000};   // after the last piece was refused
  // The store is read again after this for what others put there.
  std::chrono::milliseconds refresh_again{1000};
  // A slow link holds the caller up for this much, and nothing is received meanwhile.
  std::size_t answer_bytes_per_tick = 128U << 10U;
  // The keeper has at most so many routes in memory. The others are in the store alone and are
  // taken up when an agent mentions them. If the memory is full, a route that was not mentioned for
  // `laid_aside_after` is removed from it.
  std::size_t most_at_hand = 1024;
  std::chrono::milliseconds laid_aside_after{10'000};
  // The first Tick takes up and announces so many of the newest stored routes.
  std::uint32_t announced_at_start = 256;
};

// This is a line for the owner's log.
struct Note {
  enum class Severity : std::uint8_t { kInfo, kWarning, kError };
  Severity severity = Severity::kInfo;
  std::string text;
};

struct KeeperCounters {
  std::uint64_t appended = 0;  // pieces made durable
  std::uint64_t appended_bytes = 0;
  std::uint64_t duplicates = 0;   // pieces that were held already
  std::uint64_t corrupt = 0;      // pieces that failed their digest; dropped, and asked for again
  std::uint64_t conflicting = 0;  // pieces or announcements that contradict what is held: dropped
  std::uint64_t unproven = 0;     // lent pieces that nothing proves; dropped
  std::uint64_t store_failures = 0;
  std::uint64_t damaged = 0;   // segments found damaged in the store; asked for again
  std::uint64_t repaired = 0;  // damaged segments that some agent had
  std::uint64_t answered = 0;  // pieces sent in answer to requests
  std::uint64_t answered_bytes = 0;
  std::uint64_t receipts = 0;  // sent
};

// This is the server's end of the protocol for all routes. It makes durable what arrives,
// acknowledges it only then, asks for what it lacks, and answers requests. It has no clock and no
// socket: messages go in, messages come out, and the store is its only effect. Other servers may
// share the store: what they put there counts as held here, and one of them alone carries out what
// all of them hear, such as an edit or a request. The owner handles everything that one Take
// returned and then calls Tick, so that the pieces of one Take are one commit.
class RouteKeeper {
 public:
  using Time = std::chrono::steady_clock::time_point;
  // The owner answers these from the same store.
  struct Catalog {
    std::function<CatalogReply(const CatalogRequest&)> answer{};
    // Returns the revisions that an edit changes, as they are afterwards. It writes nothing.
    std::function<Result<std::vector<route::RouteInfo>>(const route::RouteEdit&)> plan{};
  };

  // `store` has to outlive the keeper. The time this takes does not grow with the number of routes.
  [[nodiscard]] static Result<std::unique_ptr<RouteKeeper>> Open(AgentId self,
                                                                 store::RouteStore& store,
                                                                 Catalog catalog,
                                                                 Integrity integrity,
                                                                 RouteKeeperOptions options = {});

  void Handle(Message message, Time now);
  [[nodiscard]] std::vector<Message> Tick(Time now);
  // These say what became of a message of Tick. One that was not sent, because the link is blocked,
  // is returned again by a later Tick.
  void Sent(const Message& message);
  void NotSent(const Message& message, Time now);

  // Notes that the owner takes nothing, or not all, of the revision for now. Its scout is told why.
  void TellOverQuota(const route::RouteKey& key, const std::string& why, Time now);
  // Adds a remark to the receipts of the revision, for the agent that teaches it, until another one
  // is made.
  void Remark(const route::RouteKey& key, const std::string& text, Time now);

  // Stores later labels of revisions, in one commit, and announces them.
  [[nodiscard]] Result<void> Relabel(std::span<const route::RouteInfo> infos, Time now);
  // Notes that the segment was read and is damaged. Any holder is asked for it.
  void NoteDamage(const route::RouteKey& key, SegmentIndex index, Time now);
  // Takes up a stored route that lacks segments, so that these are asked for.
  void Attend(const route::RouteKey& key, Time now) { (void)Find(key, now, Which::kStored); }
  // Drops the segments of a teaching that no agent announced. Returns false if one has by now.
  [[nodiscard]] Result<bool> DropOrphan(const route::RouteKey& key);
  // Returns segments stored since the last call, including repaired ones.
  [[nodiscard]] std::vector<route::SegmentPiece> TakeAppended();
  // Returns segments found damaged since the last call.
  [[nodiscard]] std::vector<std::pair<route::RouteKey, SegmentIndex>> TakeDamaged();
  // Tells that agents wait for segments, so that Tick has to be called soon.
  [[nodiscard]] bool answering() const { return !answers_.empty(); }
  // Tells that the last Tick did not send all that it could have.
  [[nodiscard]] bool AnswersDue(Time now) const { return answers_.IsDue(now); }

  [[nodiscard]] std::vector<Note> TakeNotes();
  [[nodiscard]] const KeeperCounters& counters() const { return counters_; }
  // Returns how many segments were announced and are not durable here.
  [[nodiscard]] std::size_t backlog() const;
  // Returns why the store refused what it was last given, for example because its disk is full. It
  // is empty if the store took it.
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
  // Tells that nothing more of it can be had.
  [[nodiscard]] bool IsSettled(const route::RouteKey& key);
  void HandleCatalogRequest(const CatalogRequest& request);
  void HandleEdit(const RouteEditRequest& request, Time now);
  // Carries the edit out, unless another server did. Returns the answer for TakeUpEdit.
  [[nodiscard]] Result<std::string> EditOnce(const RouteEditRequest& request, Time now);
  [[nodiscard]] Result<std::string> Edit(const route::RouteEdit& edit);
  // Announces labels that the store has.
  void TellRelabelled(const route::RouteInfo& info, Time now);
  // Announces what was changed. Returns the revisions as they are now.
  [[nodiscard]] Result<std::vector<route::RouteInfo>> TakeUpEdit(const std::string& answer,
                                                                 Time now);

  // Returns the route's state, which it takes up from the store if needed. It returns null, with a
  // note, if that fails, and null for a route that the store has nothing of if only stored ones are
  // asked for.
  enum class Which : std::uint8_t { kAny, kStored };
  KeptRoute* Find(const route::RouteKey& key, Time now, Which which = Which::kAny);
  [[nodiscard]] bool MakeRoom(Time now);
  // Takes up what another server may have stored, unless that was just done.
  void Refresh(const route::RouteKey& key, KeptRoute& kept, Time now);
  // Returns the segments to ask for now.
  [[nodiscard]] std::vector<SegmentIndex> Lacking(const route::RouteKey& key, KeptRoute& kept,
                                                  Time now);

  [[nodiscard]] bool IsNew(const route::SegmentPiece& piece, Time now);
  void MarkAppended(route::SegmentPiece& piece, Time now);  // it is moved away
  void Commit(Time now);
  void Append(std::span<route::SegmentPiece> pieces, Time now);
  void TellFull(std::span<const route::SegmentPiece> pieces, const Error& error);
  void Refuse(const Error& error, const route::RouteKey& key, Time now);
  // Returns true if the announced manifest is that of the held segments.
  [[nodiscard]] bool ManifestIsRight(const route::RouteInfo& info, const KeptRoute& kept, Time now);
  // Stores the infos of routes as far as they are durable, in one commit, and announces them.
  void Announce(Time now, std::vector<Message>& out);
  // Returns what has to be announced of the route now, if anything. `grown_too` includes a route
  // that has been announced before.
  [[nodiscard]] std::optional<route::RouteInfo> News(KeptRoute& kept, Time now, bool grown_too);
  // Returns the active revision of this one's route, or 0 if there is none.
  [[nodiscard]] RevisionNumber Followed(const route::RouteInfo& info);
  // Activates a route's first complete revision, unless it is held back or another server had it
  // before.
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
  std::vector<route::SegmentPiece> appended_;  // not yet returned by TakeAppended
  std::vector<Message> replies_;               // to the catalog's clients; also digests
  Time grown_due_{};                           // when infos of growing routes are stored again
  // TakeDamaged has not returned these yet.
  std::vector<std::pair<route::RouteKey, SegmentIndex>> damaged_;
  AnswerQueue answers_;
  BackupResponder backup_responder_;
  ServersThere servers_;  // other servers
  MissingRoutes missing_;
  // They are apart, since the store may have room for the one and none for the other.
  std::string segments_untaken_;
  std::string routes_untaken_;
  std::vector<Note> notes_;
  ToldLately noted_{options_.note_again};
  KeeperCounters counters_;
};

}  // namespace trailcast::exchange
