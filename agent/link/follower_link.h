#pragma once

#include <atomic>
#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <variant>
#include <vector>

#include "agent/link/feed.h"
#include "agent/link/followed_note.h"
#include "agent/link/neighbours.h"
#include "agent/link/now_desk.h"
#include "agent/link/place_note.h"
#include "agent/link/route_wish.h"
#include "agent/session/replay_session.h"
#include "services/base/mailbox.h"
#include "services/exchange/route_fetcher.h"
#include "services/exchange/route_finder.h"
#include "services/exchange/spare_holder.h"
#include "services/program/presence.h"
#include "services/store/route_store.h"

namespace trailcast::agent {

class RouteAhead;

struct FollowerLinkOptions {
  AgentId agent;
  std::string route;  // name, or an id or its beginning
  exchange::RevisionChoice revision{};
  std::string store_file;            // for messages
  bool wait_for_route = false;       // a route that nobody knows yet may still be taught
  std::filesystem::path place_file;  // where it is noted how far the robot got; empty: nowhere
  bool from_start = false;           // whatever was noted
  std::filesystem::path stop_file;   // where an operator's stop is kept; empty: nowhere
  double begin_m = 0.0;  // how far along the route the robot is set down; whatever was noted
  // Of an agent that follows many routes: its process in the fleet, which has claimed the name, and
  // what operators have told it and what it is to tell of how it followed, which outlive the link.
  // 0 and null: this link is all there is.
  std::uint64_t instance = 0;
  NowDesk* now_desk = nullptr;
  FollowedNote* followed_note = nullptr;
  std::function<program::Vitals()> vitals = [] { return program::Vitals{}; };  // the link's thread
  bool notes_followed = true;   // how it follows tells how well the route's stretches are followed
  bool feeds_segments = true;   // false: nobody drives, the segments are stored and not read back
  bool hears_operators = true;  // false: there is nothing that could be held
  // How long the agent waits for a server, the route, or the next segment, while none comes.
  std::chrono::milliseconds wait{30'000};
  std::function<bool()> stop = [] { return false; };  // any thread
};

// The follower's other half: a thread that owns store and exchange, finds the route, fetches into
// the own store what is missing, and feeds the control loop from there.
class FollowerLink {
 public:
  // `exchange` may be null: then the route comes from the own store alone.
  FollowerLink(FollowerLinkOptions options, std::unique_ptr<store::RouteStore> store,
               std::unique_ptr<exchange::RouteExchange> exchange);
  ~FollowerLink();
  FollowerLink(const FollowerLink&) = delete;
  FollowerLink& operator=(const FollowerLink&) = delete;

  // Claims the name, then starts the thread.
  [[nodiscard]] Result<void> Start();

  // For the control loop. Neither takes a lock nor waits.
  [[nodiscard]] std::optional<Feed> TryTake() { return feed_.TryGet(); }
  void Report(const ReplayStep& step);
  // Of the route's segments, those that were in the own store when the fetching began, and those
  // that came since. Any thread.
  [[nodiscard]] std::uint32_t held_before() const { return held_before_; }
  [[nodiscard]] std::uint32_t fetched() const { return fetched_; }
  // Who else is on the route, whenever that has changed. Nothing before the route was fed.
  [[nodiscard]] std::optional<std::vector<Neighbour>> TryTakeNeighbours() {
    return told_neighbours_.TryGet();
  }
  // How operators have the robot stand, whenever that has changed; before the route is fed, if an
  // earlier run was stopped.
  [[nodiscard]] std::optional<Hold> TryTakeHold() { return told_hold_.TryGet(); }
  // Another route, to be had ready besides, once all of this one is here; instead of the one wished
  // for before. False: it does not hear that now.
  [[nodiscard]] bool Wish(RouteWish wish) { return wishes_.TryPut(std::move(wish)); }
  struct AheadFeed {
    std::uint32_t wish = 0;  // its number
    Feed item{};
  };
  [[nodiscard]] std::optional<AheadFeed> TryTakeAhead() { return ahead_feed_.TryGet(); }
  // While the robot stands: waits until something was fed, others have moved, or `at_most`.
  void WaitForNews(std::chrono::milliseconds at_most) { fed_.Wait(at_most); }

  // Ends the thread.
  void Finish();
  // The last status peers see, and what the next run is told. After Finish.
  void Close(exchange::AgentMode mode, const std::string& detail);
  // As far as it is known. After Finish.
  [[nodiscard]] const std::optional<route::RouteInfo>& route() const { return route_; }

 private:
  using Time = std::chrono::steady_clock::time_point;

  void Run();
  [[nodiscard]] Result<void> Work();
  [[nodiscard]] Result<void> Find();
  [[nodiscard]] Result<std::optional<route::RouteInfo>> FindOwn();
  [[nodiscard]] Result<bool> Asked(Time began, const std::optional<route::RouteInfo>& own);
  [[nodiscard]] Result<void> StartFetching();
  [[nodiscard]] Result<void> MakeFetcher(const std::vector<exchange::RouteFetcher::Held>& held);
  [[nodiscard]] Result<void> Follow();
  void Trade();
  [[nodiscard]] Result<void> Listen(Time now);
  void Say(Time now);  // what the fetcher or the finder, and whoever lends, have to say
  [[nodiscard]] Result<void> StoreArrived();
  [[nodiscard]] Result<void> DropWrong(std::uint32_t count);
  [[nodiscard]] Result<void> StoreNews();
  [[nodiscard]] Result<void> TellHeld();
  void CountHeld(SegmentIndex stored);
  [[nodiscard]] Result<void> FeedAll();
  void HearWish();
  [[nodiscard]] Result<void> FeedAhead();
  [[nodiscard]] bool all_known() const;
  [[nodiscard]] bool TryPut(Feed item);
  [[nodiscard]] std::optional<LeftAt> ReadPlace() const;
  void NotePlace();
  void EndNote(exchange::AgentMode mode);
  void TakeReports();
  void ShowStatus();
  void HearServer();
  void TellNeighbours(Time now);
  void HearOperators(const exchange::Message& message);
  void AnswerOperators();
  [[nodiscard]] bool TellHold();  // false: not yet
  [[nodiscard]] bool over() const { return ending_.load() || options_.stop(); }

  FollowerLinkOptions options_;
  std::unique_ptr<store::RouteStore> store_;
  std::unique_ptr<exchange::RouteExchange> exchange_;
  std::optional<program::Presence> presence_;
  exchange::RouteFinder finder_;
  std::optional<route::RouteInfo> route_;   // the newest that is known of it
  std::optional<route::RouteInfo> stored_;  // what of that is in the own store
  std::optional<exchange::RouteFetcher> fetcher_;
  std::unique_ptr<RouteAhead> ahead_;
  exchange::SpareHolder spare_;
  PlaceNote place_note_;
  std::optional<NotedPlace> place_;  // the last that the robot was sure of
  std::optional<Time> noted_;        // when
  Neighbours neighbours_;
  std::vector<Neighbour> told_;      // to the control loop
  std::optional<NowDesk> own_desk_;  // unless it was lent one
  NowDesk& now_desk_;
  FollowedNote own_note_;  // likewise
  FollowedNote& followed_note_;
  Hold hold_told_;  // to the control loop
  std::vector<route::RouteKey> held_revisions_;
  std::uint32_t held_ = 0;         // segments in the own store without a gap
  std::set<SegmentIndex> beyond_;  // those after the first gap
  std::uint32_t next_feed_ = 0;
  std::atomic<std::uint32_t> held_before_ = 0;
  std::atomic<std::uint32_t> fetched_ = 0;
  bool fed_all_ = false;
  bool dropped_wrong_ = false;  // once is enough: then it is whoever sends them
  std::string waiting_for_ = "starting";
  std::optional<AgentId> told_server_;

  Mailbox<Feed> feed_{16};
  Mailbox<RouteWish> wishes_{4};
  Mailbox<AheadFeed> ahead_feed_{16};
  Mailbox<std::vector<Neighbour>> told_neighbours_{4};
  Mailbox<Hold> told_hold_{4};
  Mailbox<ReplayStep> reports_{64};
  ReplayStep latest_;
  Bell fed_;
  Bell reported_;
  std::atomic<bool> ending_{false};
  std::thread thread_;
};

}  // namespace trailcast::agent
