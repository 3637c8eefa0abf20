#include "services/exchange/topics.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace trailcast::exchange {

namespace {

bool Contains(const std::vector<Topic>& topics, Topic topic) {
  return std::find(topics.begin(), topics.end(), topic) != topics.end();
}

}  // namespace

bool TopicUse::Writes(Topic topic) const {
  return Contains(write, topic) || Contains(write_rarely, topic);
}
bool TopicUse::Reads(Topic topic) const { return Contains(read, topic); }
bool TopicUse::Hears(Topic topic) const { return Reads(topic) || Contains(overhear, topic); }
bool TopicUse::Listens(Topic topic) const { return Contains(listen, topic); }

TopicUse ScoutTopics() {
  return {.write = {Topic::kRoutes, Topic::kSegments, Topic::kAgents},
          .read = {Topic::kSegmentRequests, Topic::kReceipts}};
}

TopicUse FollowerTopics() {
  return {.write = {Topic::kSegmentRequests, Topic::kCatalogRequests, Topic::kAgents},
          .read = {Topic::kRoutes, Topic::kCatalogReplies, Topic::kNow},
          // Segments that it may lend (PeerCache) are asked for more than once.
          .overhear = {Topic::kSegmentRequests},
          // Commands are repeated until they are answered.
          .write_rarely = {Topic::kSegments, Topic::kNowAnswers},
          .listen = {Topic::kSegments, Topic::kNeighbours}};
}

TopicUse ServerTopics() {
  return {
      .write = {Topic::kRoutes, Topic::kSegmentRequests, Topic::kReceipts, Topic::kCatalogReplies,
                Topic::kAgents, Topic::kFleet, Topic::kNow, Topic::kMissions, Topic::kMissionStates,
                Topic::kStores},
      .read = {Topic::kRoutes, Topic::kSegments, Topic::kSegmentRequests, Topic::kStores,
               Topic::kCatalogRequests, Topic::kAgents, Topic::kRouteEdits, Topic::kNow,
               Topic::kNowAnswers, Topic::kMissions, Topic::kMissionStates, Topic::kMissionRequests,
               Topic::kNetworkEdits, Topic::kNetworkRequests, Topic::kFollowed,
               Topic::kReachRequests, Topic::kReachReports, Topic::kPhotos, Topic::kPhotoRequests},
      .write_rarely = {Topic::kSegments, Topic::kNeighbours, Topic::kNowAnswers,
                       Topic::kMissionReplies, Topic::kNetworkReplies, Topic::kReachRequests,
                       Topic::kReachReports, Topic::kPhotos, Topic::kPhotoRequests}};
}

TopicUse OperatorTopics() {
  return {.write = {Topic::kCatalogRequests, Topic::kRouteEdits},
          .read = {Topic::kRoutes, Topic::kCatalogReplies, Topic::kAgents}};
}

TopicUse DispatcherTopics() {
  return {
      .write = {Topic::kNow, Topic::kMissionRequests},
      .read = {Topic::kNowAnswers, Topic::kMissionReplies, Topic::kMissionStates, Topic::kAgents}};
}

TopicUse ReplayTopics() {
  TopicUse use = FollowerTopics();
  use.write.push_back(Topic::kFollowed);
  return use;
}

TopicUse OnDutyTopics() {
  TopicUse use = ReplayTopics();
  use.read.push_back(Topic::kMissions);
  use.read.push_back(Topic::kMissionStates);  // of missions that servers have
  use.write.push_back(Topic::kMissionStates);
  use.read.push_back(Topic::kSnapshotRequests);
  use.write_rarely.push_back(Topic::kSnapshots);
  use.read.push_back(Topic::kPhotoRequests);  // from servers
  use.write_rarely.push_back(Topic::kPhotos);
  return use;
}

TopicUse TeachingTopics() {
  TopicUse use = ScoutTopics();
  use.read.push_back(Topic::kDrives);
  return use;
}

TopicUse SenderTopics() {
  return {.write = {Topic::kMissions}, .read = {Topic::kMissionStates, Topic::kAgents}};
}

TopicUse HistoryTopics() {
  return {.write = {Topic::kMissionRequests}, .read = {Topic::kMissionReplies}};
}

TopicUse DriverTopics() { return {.write = {Topic::kDrives}, .read = {}}; }

TopicUse SnapshotTopics() {
  return {.write = {Topic::kSnapshotRequests}, .read = {Topic::kSnapshots}};
}

TopicUse PhotoTopics() { return {.write = {Topic::kPhotoRequests}, .read = {Topic::kPhotos}}; }

TopicUse NetworkTopics() {
  return {.write = {Topic::kNetworkRequests}, .read = {Topic::kNetworkReplies}};
}

TopicUse JoinerTopics() {
  return {.write = {Topic::kNetworkEdits}, .read = {Topic::kNetworkReplies}};
}

TopicUse ReachTopics() {
  return {.write = {Topic::kReachRequests}, .read = {Topic::kReachReports, Topic::kAgents}};
}

TopicUse ObserverTopics() {
  TopicUse use = OperatorTopics();
  std::erase(use.write, Topic::kRouteEdits);
  return use;
}

std::optional<Topic> TopicOf(const Message& message) {
  // This is the order of the variant. AgentGone, the last, is not a topic.
  static constexpr Topic kInOrder[] = {Topic::kRoutes,
                                       Topic::kSegments,
                                       Topic::kSegmentRequests,
                                       Topic::kReceipts,
                                       Topic::kCatalogRequests,
                                       Topic::kCatalogReplies,
                                       Topic::kAgents,
                                       Topic::kRouteEdits,
                                       Topic::kFleet,
                                       Topic::kNeighbours,
                                       Topic::kNow,
                                       Topic::kNowAnswers,
                                       Topic::kMissions,
                                       Topic::kMissionStates,
                                       Topic::kMissionRequests,
                                       Topic::kMissionReplies,
                                       Topic::kDrives,
                                       Topic::kSnapshotRequests,
                                       Topic::kSnapshots,
                                       Topic::kNetworkEdits,
                                       Topic::kNetworkRequests,
                                       Topic::kNetworkReplies,
                                       Topic::kFollowed,
                                       Topic::kReachRequests,
                                       Topic::kReachReports,
                                       Topic::kStores,
                                       Topic::kPhotos,
                                       Topic::kPhotoRequests};
  if (message.index() >= std::size(kInOrder)) return std::nullopt;
  return kInOrder[message.index()];
}

bool IsOfRoutes(Topic topic) { return topic == Topic::kSegments || topic == Topic::kNeighbours; }

const route::RouteKey* RouteOf(const Message& message) {
  if (const auto* followers = std::get_if<RouteFollowers>(&message)) return &followers->key;
  const auto* batch = std::get_if<SegmentBatch>(&message);
  return batch == nullptr || batch->pieces.empty() ? nullptr : &batch->pieces.front().key;
}

const char* NameOf(Topic topic) {
  switch (topic) {
    case Topic::kRoutes:
      return "trailcast/routes";
    case Topic::kSegments:
      return "trailcast/segments";
    case Topic::kSegmentRequests:
      return "trailcast/segment_requests";
    case Topic::kReceipts:
      return "trailcast/receipts";
    case Topic::kCatalogRequests:
      return "trailcast/catalog_requests";
    case Topic::kCatalogReplies:
      return "trailcast/catalog_replies";
    case Topic::kAgents:
      return "trailcast/agents";
    case Topic::kRouteEdits:
      return "trailcast/route_edits";
    case Topic::kFleet:
      return "trailcast/fleet";
    case Topic::kNeighbours:
      return "trailcast/neighbours";
    case Topic::kNow:
      return "trailcast/now";
    case Topic::kNowAnswers:
      return "trailcast/now_answers";
    case Topic::kMissions:
      return "trailcast/missions";
    case Topic::kMissionStates:
      return "trailcast/mission_states";
    case Topic::kMissionRequests:
      return "trailcast/mission_requests";
    case Topic::kMissionReplies:
      return "trailcast/mission_replies";
    case Topic::kDrives:
      return "trailcast/drives";
    case Topic::kSnapshotRequests:
      return "trailcast/snapshot_requests";
    case Topic::kSnapshots:
      return "trailcast/snapshots";
    case Topic::kNetworkEdits:
      return "trailcast/network_edits";
    case Topic::kNetworkRequests:
      return "trailcast/network_requests";
    case Topic::kNetworkReplies:
      return "trailcast/network_replies";
    case Topic::kFollowed:
      return "trailcast/followed";
    case Topic::kReachRequests:
      return "trailcast/reach_requests";
    case Topic::kReachReports:
      return "trailcast/reach_reports";
    case Topic::kStores:
      return "trailcast/stores";
    case Topic::kPhotos:
      return "trailcast/photos";
    case Topic::kPhotoRequests:
      return "trailcast/photo_requests";
  }
  return "unknown topic";
}

std::string InstanceOf(const Message& message) {
  const auto key_text = [](const route::RouteKey& key) {
    return key.route.value() + "/" + fmt::format("{:x}", key.teaching.value());
  };
  if (const auto* route = std::get_if<RouteAnnouncement>(&message)) {
    return "routes/" + route->holder.value() + "/" + key_text(route->info.key);
  }
  if (const auto* receipt = std::get_if<Receipt>(&message)) {
    return "receipts/" + receipt->server.value() + "/" + key_text(receipt->key);
  }
  if (const auto* status = std::get_if<AgentStatus>(&message)) {
    return "agents/" + status->agent.value() + "/" + std::to_string(status->instance);
  }
  if (const auto* fleet = std::get_if<Fleet>(&message)) return "fleet/" + fleet->server.value();
  return "";
}

}  // namespace trailcast::exchange
