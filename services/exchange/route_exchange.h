#pragma once

#include <chrono>
#include <set>
#include <vector>

#include "services/base/result.h"
#include "services/exchange/messages.h"

namespace trailcast::exchange {

// Which topics a process takes part in. Few endpoints keep discovery quick, so each role names its
// own: a scout reads requests and receipts, a follower reads routes and segments, and so on.
enum class Topic : std::uint8_t {
  kRoutes,
  kSegments,
  kSegmentRequests,
  kReceipts,
  kCatalogRequests,
  kCatalogReplies,
  kAgents,
  kRouteEdits,
  kFleet,
  kNeighbours,
  kNow,
  kNowAnswers,
  kMissions,
  kMissionStates,
  kMissionRequests,
  kMissionReplies,
  kDrives,
  kGlanceRequests,
  kGlances,
  kNetworkEdits,
  kNetworkRequests,
  kNetworkReplies,
  kFollowed,
  kReachRequests,
  kReachReports,
  kStores,
};

struct TopicUse {
  // Segments: from the announcement of their route on.
  std::vector<Topic> write;
  std::vector<Topic> read;
  // Read best-effort, from the join on: for what many say again and again to many, where the
  // confirmations of all readers would cost far more than what is lost.
  std::vector<Topic> overhear = {};
  // Written, but by few who could: the writer comes to be with the first message, which nobody may
  // hear yet. For what is said again when it is asked for again.
  std::vector<Topic> write_rarely = {};
  // Read of those routes alone that RouteExchange::Listen names, and only while it names them.
  std::vector<Topic> listen = {};

  [[nodiscard]] bool Writes(Topic topic) const;
  [[nodiscard]] bool Reads(Topic topic) const;
  [[nodiscard]] bool Hears(Topic topic) const;    // reads or overhears
  [[nodiscard]] bool Listens(Topic topic) const;  // to some routes
};

[[nodiscard]] TopicUse ScoutTopics();
[[nodiscard]] TopicUse FollowerTopics();
[[nodiscard]] TopicUse ServerTopics();
[[nodiscard]] TopicUse OperatorTopics();    // reads routes, agents, catalog replies; asks the
                                            // catalog, edits routes
[[nodiscard]] TopicUse DispatcherTopics();  // of who tells robots what to do now
[[nodiscard]] TopicUse ReplayTopics();      // a follower's that drives, and tells how that went
[[nodiscard]] TopicUse OnDutyTopics();      // a follower's that is sent on missions
[[nodiscard]] TopicUse TeachingTopics();    // a scout's that is driven by operators
[[nodiscard]] TopicUse SenderTopics();      // of who sends missions
[[nodiscard]] TopicUse HistoryTopics();     // of who asks what became of them
[[nodiscard]] TopicUse DriverTopics();      // of who drives a robot that teaches
[[nodiscard]] TopicUse GlanceTopics();      // of who looks through robots' cameras
[[nodiscard]] TopicUse NetworkTopics();     // of who asks for ways over routes
[[nodiscard]] TopicUse JoinerTopics();      // of who joins routes
[[nodiscard]] TopicUse ReachTopics();       // of who asks all whom they hear
[[nodiscard]] TopicUse ObserverTopics();    // the same without edits

// The bus on which routes are shared. Implemented in process (InProcessExchange, for tests) and
// over DDS (dds/); one contract suite runs against both. Not thread-safe: one owner thread
// publishes and takes. Delivery is reliable while both ends are up and keep taking; who needs more
// (what was missed while away) asks for it: see RouteSender, RouteFetcher, RouteKeeper.
class RouteExchange {
 public:
  virtual ~RouteExchange() = default;
  RouteExchange(const RouteExchange&) = delete;
  RouteExchange& operator=(const RouteExchange&) = delete;

  // kUnavailable when the message could not be handed over (it was then not sent: try again);
  // kInvalidArgument for a topic this exchange was not opened to write, or a message out of bounds.
  [[nodiscard]] virtual Result<void> Publish(const Message& message) = 0;

  // What is published from now on may be held back until Flush, so that small messages travel
  // together.
  virtual void Gather() {}
  virtual void Flush() {}

  // Everything received since the last call, oldest first within a topic. Waits for the first
  // message up to `max_wait`. Own messages never come back. Late joiners get the latest sample per
  // key of the routes, receipts and agents topics; other topics start at the join. Messages that
  // cannot be decoded are dropped and counted (dropped()).
  [[nodiscard]] virtual std::vector<Message> Take(std::chrono::milliseconds max_wait) = 0;

  // From now on `topic`, one of TopicUse::listen, is read of these routes and no others. Who writes
  // notices that in the background, within milliseconds or a second; what it wrote before that is
  // not received, and nothing but hearing it tells that it is over (RouteFetcher knocks). Costs
  // nothing when the routes are those of the last call.
  [[nodiscard]] virtual Result<void> Listen(Topic topic,
                                            const std::set<route::RouteKey>& routes) = 0;

  // Samples received and thrown away because they were out of bounds or could not be decoded.
  [[nodiscard]] virtual std::uint64_t dropped() const = 0;

 protected:
  RouteExchange() = default;
};

}  // namespace trailcast::exchange
