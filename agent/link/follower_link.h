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
#include "agent/link/now_handler.h"
#include "agent/link/place_note.h"
#include "agent/link/route_wish.h"
#include "agent/session/replay_session.h"
#include "services/base/mailbox.h"
#include "services/exchange/peer_cache.h"
#include "services/exchange/route_fetcher.h"
#include "services/exchange/route_finder.h"
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
  std::filesystem::path place_file;  // the file that notes how far the robot got; empty for none
  bool from_start = false;           // whatever was noted
  std::filesystem::path stop_file;   // the file that keeps an operator's stop; empty for none
  double begin_m = 0.0;  // how far along the route the robot is set down, whatever was noted
  // These belong to an agent that follows many routes, and outlive the link: its process, which has
  // claimed the name in the fleet; operators' commands; and its counts of how it followed. With 0
  // and null, the link has its own.
  std::uint64_t instance = 0;
  NowHandler* now_handler = nullptr;
  FollowedNote* followed_note = nullptr;
  // called by the link's thread
  std::function<program::Vitals()> vitals = [] { return program::Vitals{}; };
  bool notes_followed = true;   // this drive counts for how well the route's sections are followed
  bool feeds_segments = true;   // false if nobody drives; segments are then stored, but not read
                                // back
  bool hears_operators = true;  // false if there is nothing that could be stopped
  // How long the agent waits for a server, the route, or the next segment while none comes.
  std::chrono::milliseconds wait{30'000};
  std::function<bool()> stop = [] { return false; };  // called by any thread
};

// The follower's other half: a thread that owns the store and the exchange, finds the route,
// fetches missing segments into the own store, and feeds the control loop from there.
class FollowerLink {
 public:
  // `exchange` may be null; the route then comes from the own store alone.
  FollowerLink(FollowerLinkOptions options, std::unique_ptr<store::RouteStore> store,
               std::unique_ptr<exchange::RouteExchange> exchange);
  ~FollowerLink();
  FollowerLink(const FollowerLink&) = delete;
  FollowerLink& operator=(const FollowerLink&) = delete;

  // Claims the name, then starts the thread.
  [[nodiscard]] Result<void> Start();

  // Both are for the control loop, and neither takes a lock nor waits.
  [[nodiscard]] std::optional<Feed> TryTake() { return feed_.TryGet(); }
  void Report(const ReplayStep& step);
  // Return how many of the route's segments were in the own store when fetching began, and how many
  // came since. Any thread may call them.
  [[nodiscard]] std::uint32_t held_before() const { return held_before_; }
  [[nodiscard]] std::uint32_t fetched() const { return fetched_; }
  // Returns the other robots on the route whenever they have changed; nothing before the route was
  // fed.
  [[nodiscard]] std::optional<std::vector<Neighbour>> TryTakeNeighbours() {
    return told_neighbours_.TryGet();
  }
  // Returns the operators' hold on the robot whenever it has changed. If an earlier run was
  // stopped, it comes before the route.
  [[nodiscard]] std::optional<Hold> TryTakeHold() { return told_hold_.TryGet(); }
  // Asks for another route to be kept ready, once all of this one is here. It replaces the last
  // wish. False means that the link cannot hear it now.
  [[nodiscard]] bool Wish(RouteWish wish) { return wishes_.TryPut(std::move(wish)); }
  struct AheadFeed {
    std::uint32_t wish = 0;  // its number
    Feed item{};
  };
  [[nodiscard]] std::optional<AheadFeed> TryTakeAhead() { return ahead_feed_.TryGet(); }
  // Waits, while the robot stands, until something was fed, others have moved, or `at_most` is
  // over.
  void WaitForNews(std::chrono::milliseconds at_most) { fed_.Wait(at_most); }

  // Ends the thread.
  void Finish();
  // Publishes the last status that peers see, and notes the place for the next run. Only after
  // Finish.
  void Close(exchange::AgentMode mode, const std::string& detail);
  // Returns the route as far as it is known. Only after Finish.
  [[nodiscard]] const std::optional<route::RouteInfo>& route() const { return route_; }

 private:
  using Time = std::chrono::steady_clock::time_point;

  void Run();
  [[nodiscard]] Result<void> Work();
  [[nodiscard]] Result<void> Find();
  [[nodiscard]] Result<std::optional<route::RouteInfo>> FindOwn();
  [[nodiscard]] Result<bool> Asked(Time began, const std::optional<route::RouteInfo>& own);
  [[nodiscard]] Error WaitedInVain() const;
  [[nodiscard]] Result<void> StartFetching();
  [[nodiscard]] Result<void> MakeFetcher(const std::vector<exchange::RouteFetcher::Held>& held);
  [[nodiscard]] Result<void> Follow();
  void Trade();
  [[nodiscard]] Result<void> Listen(Time now);
  void Say(Time now);  // publishes what the fetcher or the finder and the peer server have to say
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
  [[nodiscard]] bool TellHold();  // false if the loop cannot take it yet
  [[nodiscard]] bool over() const { return ending_.load() || options_.stop(); }

  FollowerLinkOptions options_;
  std::unique_ptr<store::RouteStore> store_;
  std::unique_ptr<exchange::RouteExchange> exchange_;
  std::optional<program::Presence> presence_;
  exchange::RouteFinder finder_;
  std::optional<route::RouteInfo> route_;   // the newest version known
  std::optional<route::RouteInfo> stored_;  // the version in the own store
  std::optional<exchange::RouteFetcher> fetcher_;
  std::unique_ptr<RouteAhead> ahead_;
  exchange::PeerCache peer_cache_;
  PlaceNote place_note_;
  std::optional<NotedPlace> place_;  // the last one of which the robot was sure
  std::optional<Time> noted_;        // when that was noted
  Neighbours neighbours_;
  std::vector<Neighbour> told_;            // what the control loop knows
  std::optional<NowHandler> own_handler_;  // unless it was given one
  NowHandler& now_handler_;
  FollowedNote own_note_;  // likewise
  FollowedNote& followed_note_;
  Hold hold_told_;  // what the control loop knows
  std::vector<route::RouteKey> held_revisions_;
  std::uint32_t held_ = 0;         // segments in the own store without a gap
  std::set<SegmentIndex> beyond_;  // segments after the first gap
  std::uint32_t next_feed_ = 0;
  std::atomic<std::uint32_t> held_before_ = 0;
  std::atomic<std::uint32_t> fetched_ = 0;
  bool fed_all_ = false;
  bool dropped_wrong_ = false;  // once is enough: after that, their senders are to blame
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
