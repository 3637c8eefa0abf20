#pragma once

#include <chrono>
#include <set>
#include <vector>

#include "services/base/result.h"
#include "services/exchange/messages.h"

namespace trailcast::exchange {

// These are the topics that a process may take part in. Few endpoints keep discovery quick, so each
// role names its own: a scout reads requests and receipts, a follower reads routes and segments,
// and so on.
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
  kSnapshotRequests,
  kSnapshots,
  kNetworkEdits,
  kNetworkRequests,
  kNetworkReplies,
  kFollowed,
  kReachRequests,
  kReachReports,
  kStores,
  kPhotos,
  kPhotoRequests,
};

struct TopicUse {
  // Segments may be written from the announcement of their route on.
  std::vector<Topic> write;
  std::vector<Topic> read;
  // These are read best-effort, from the join on. Many agents repeat them to many, and
  // confirmations of all readers would cost far more than what is lost.
  std::vector<Topic> overhear = {};
  // These are written by few of those who could. The writer is created with the first message,
  // which no reader may hear yet, so this suits what is repeated when it is asked for again.
  std::vector<Topic> write_rarely = {};
  // These are read only of the routes that RouteExchange::Listen names, and only while it names
  // them.
  std::vector<Topic> listen = {};

  [[nodiscard]] bool Writes(Topic topic) const;
  [[nodiscard]] bool Reads(Topic topic) const;
  [[nodiscard]] bool Hears(Topic topic) const;    // reads or overhears
  [[nodiscard]] bool Listens(Topic topic) const;  // to some routes
};

[[nodiscard]] TopicUse ScoutTopics();
[[nodiscard]] TopicUse FollowerTopics();
[[nodiscard]] TopicUse ServerTopics();
// An operator reads routes, agents and catalog replies, asks the catalog, and edits routes.
[[nodiscard]] TopicUse OperatorTopics();
[[nodiscard]] TopicUse DispatcherTopics();  // tells robots what to do now
[[nodiscard]] TopicUse ReplayTopics();      // a follower that drives, and reports how that went
[[nodiscard]] TopicUse OnDutyTopics();      // a follower that is available for missions
[[nodiscard]] TopicUse TeachingTopics();    // a scout that operators drive
[[nodiscard]] TopicUse SenderTopics();      // sends missions
[[nodiscard]] TopicUse HistoryTopics();     // asks what became of missions
[[nodiscard]] TopicUse DriverTopics();      // drives a robot that teaches
[[nodiscard]] TopicUse SnapshotTopics();    // looks through robots' cameras
[[nodiscard]] TopicUse PhotoTopics();       // fetches photos from servers
[[nodiscard]] TopicUse NetworkTopics();     // asks for paths over routes
[[nodiscard]] TopicUse JoinerTopics();      // joins routes
[[nodiscard]] TopicUse ReachTopics();       // asks all agents whom they hear
[[nodiscard]] TopicUse ObserverTopics();    // the same without edits

// This is the bus on which routes are shared. It is implemented in process (InProcessExchange, for
// tests) and over DDS (dds/), and one contract suite tests both. It is not thread-safe: one owner
// thread publishes and takes. Delivery is reliable while both ends are up and keep taking.
// RouteSender, RouteFetcher and RouteKeeper ask for what was missed in other cases.
class RouteExchange {
 public:
  virtual ~RouteExchange() = default;
  RouteExchange(const RouteExchange&) = delete;
  RouteExchange& operator=(const RouteExchange&) = delete;

  // Returns kUnavailable if the message could not be handed over: it was not sent and may be tried
  // again. Returns kInvalidArgument for a topic that this exchange was not opened to write, or a
  // message out of bounds.
  [[nodiscard]] virtual Result<void> Publish(const Message& message) = 0;

  // After Gather, messages may be held back until Flush, so that small ones travel together.
  virtual void Gather() {}
  virtual void Flush() {}

  // Returns everything received since the last call, the oldest first within a topic, and waits up
  // to `max_wait` for the first message. Own messages never come back. Late joiners get the latest
  // sample per key of the routes, receipts and agents topics; other topics start at the join.
  // Messages that cannot be decoded are dropped and counted (dropped()).
  [[nodiscard]] virtual std::vector<Message> Take(std::chrono::milliseconds max_wait) = 0;

  // Reads `topic`, one of TopicUse::listen, of these routes and no others from now on. Writers
  // notice that in the background, within milliseconds or a second. Earlier samples are not
  // received, and only hearing it tells that this is over (RouteFetcher knocks). A call with the
  // same routes as the last costs nothing.
  [[nodiscard]] virtual Result<void> Listen(Topic topic,
                                            const std::set<route::RouteKey>& routes) = 0;

  // Returns how many received samples were dropped because they were out of bounds or could not be
  // decoded.
  [[nodiscard]] virtual std::uint64_t dropped() const = 0;

 protected:
  RouteExchange() = default;
};

}  // namespace trailcast::exchange
