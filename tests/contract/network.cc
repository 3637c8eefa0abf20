#include "tests/contract/network.h"

#include <algorithm>
#include <chrono>
#include <stdexcept>

#include "services/exchange/in_process_exchange.h"
#include "tests/support/await.h"
#include "tests/support/pieces.h"

namespace trailcast::test {
namespace {

using exchange::Message;
using exchange::RouteExchange;
using exchange::Topic;
using std::chrono::milliseconds;
using Clock = std::chrono::steady_clock;

const AgentId kProbe("probe");

class InProcessNetwork : public Network {
 public:
  std::unique_ptr<RouteExchange> Open(const exchange::TopicUse& use) override {
    return bus_.Open(use);
  }

 private:
  exchange::InProcessBus bus_;
};

class DdsNetwork : public Network {
 public:
  std::unique_ptr<RouteExchange> Open(const exchange::TopicUse& use) override {
    auto opened = dds::OpenDdsExchange(LoopbackOptions(tag_), use);
    if (!opened) throw std::runtime_error(opened.error().message);
    return *std::move(opened);
  }

 private:
  std::string tag_ = UniqueTag();
};

Message ProbeFor(Topic topic) {
  const route::RouteKey key = ProbeRoute();
  switch (topic) {
    case Topic::kRoutes:
      return exchange::RouteAnnouncement{kProbe, InfoOf(key, {}, route::RouteState::kTeaching)};
    case Topic::kSegments:
      return exchange::SegmentBatch{kProbe, {PieceOf(key, 0)}};
    case Topic::kSegmentRequests:
      return exchange::SegmentRequest{kProbe, key, {}};
    case Topic::kReceipts:
      return exchange::Receipt{.server = kProbe, .key = key};
    case Topic::kCatalogRequests:
      return exchange::CatalogRequest{.client = kProbe};
    case Topic::kCatalogReplies:
      return exchange::CatalogReply{.server = kProbe, .client = kProbe};
    case Topic::kRouteEdits:
      return exchange::RouteEditRequest{.client = kProbe};
    case Topic::kFleet:
      return exchange::Fleet{.server = kProbe};
    case Topic::kNeighbours:
      return exchange::RouteFollowers{.server = kProbe, .key = key};
    case Topic::kNow:
      return exchange::NowCommand{.client = kProbe};
    case Topic::kNowAnswers:
      return exchange::NowAnswer{.agent = kProbe, .client = kProbe};
    case Topic::kMissions:
      return mission::Mission{.agent = kProbe, .id = "probe", .client = kProbe};
    case Topic::kMissionStates:
      return mission::Report{.agent = kProbe, .mission = "probe"};
    case Topic::kMissionRequests:
      return exchange::MissionRequest{.client = kProbe};
    case Topic::kMissionReplies:
      return exchange::MissionReply{.server = kProbe, .client = kProbe};
    case Topic::kDrives:
      return exchange::DriveCommand{.agent = kProbe, .client = kProbe};
    case Topic::kSnapshotRequests:
      return exchange::SnapshotRequest{.agent = kProbe, .client = kProbe};
    case Topic::kSnapshots:
      return exchange::Snapshot{.agent = kProbe, .client = kProbe};
    case Topic::kNetworkEdits:
      return exchange::NetworkEdit{.client = kProbe};
    case Topic::kNetworkRequests:
      return exchange::NetworkRequest{.client = kProbe};
    case Topic::kNetworkReplies:
      return exchange::NetworkReply{.server = kProbe, .client = kProbe};
    case Topic::kFollowed:
      return exchange::FollowedSections{.agent = kProbe, .key = key};
    case Topic::kReachRequests:
      return exchange::ReachRequest{.client = kProbe};
    case Topic::kReachReports:
      return exchange::ReachReport{.agent = kProbe, .client = kProbe};
    case Topic::kStores:
      return exchange::StoreSummary{.server = kProbe};
    case Topic::kPhotos:
      return exchange::PhotoPiece{.holder = kProbe, .client = kProbe, .photo = "probe"};
    case Topic::kPhotoRequests:
      return exchange::PhotoRequest{.client = kProbe, .holder = kProbe, .photo = "probe"};
    case Topic::kAgents:
      break;
  }
  return exchange::AgentStatus{.agent = kProbe};
}

}  // namespace

route::RouteKey ProbeRoute() { return KeyNumber(0xABCDEF); }

bool IsProbe(const Message& message) {
  struct Sender {
    AgentId operator()(const exchange::RouteAnnouncement& m) { return m.holder; }
    AgentId operator()(const exchange::SegmentBatch& m) { return m.sender; }
    AgentId operator()(const exchange::SegmentRequest& m) { return m.requester; }
    AgentId operator()(const exchange::Receipt& m) { return m.server; }
    AgentId operator()(const exchange::RouteEditRequest& m) { return m.client; }
    AgentId operator()(const exchange::CatalogRequest& m) { return m.client; }
    AgentId operator()(const exchange::CatalogReply& m) { return m.server; }
    AgentId operator()(const exchange::AgentStatus& m) { return m.agent; }
    AgentId operator()(const exchange::Fleet& m) { return m.server; }
    AgentId operator()(const exchange::RouteFollowers& m) { return m.server; }
    AgentId operator()(const exchange::NowCommand& m) { return m.client; }
    AgentId operator()(const exchange::NowAnswer& m) { return m.agent; }
    AgentId operator()(const mission::Mission& m) { return m.client; }
    AgentId operator()(const mission::Report& m) { return m.agent; }
    AgentId operator()(const exchange::MissionRequest& m) { return m.client; }
    AgentId operator()(const exchange::MissionReply& m) { return m.server; }
    AgentId operator()(const exchange::DriveCommand& m) { return m.client; }
    AgentId operator()(const exchange::SnapshotRequest& m) { return m.client; }
    AgentId operator()(const exchange::Snapshot& m) { return m.agent; }
    AgentId operator()(const exchange::NetworkEdit& m) { return m.client; }
    AgentId operator()(const exchange::NetworkRequest& m) { return m.client; }
    AgentId operator()(const exchange::NetworkReply& m) { return m.server; }
    AgentId operator()(const exchange::FollowedSections& m) { return m.agent; }
    AgentId operator()(const exchange::ReachRequest& m) { return m.client; }
    AgentId operator()(const exchange::ReachReport& m) { return m.agent; }
    AgentId operator()(const exchange::StoreSummary& m) { return m.server; }
    AgentId operator()(const exchange::PhotoPiece& m) { return m.holder; }
    AgentId operator()(const exchange::PhotoRequest& m) { return m.client; }
    AgentId operator()(const exchange::AgentGone& m) { return m.agent; }
  };
  return std::visit(Sender(), message) == kProbe;
}

std::unique_ptr<Network> MakeNetwork(NetworkKind kind) {
  if (kind == NetworkKind::kInProcess) return std::make_unique<InProcessNetwork>();
  return std::make_unique<DdsNetwork>();
}

std::string NameOf(NetworkKind kind) {
  return kind == NetworkKind::kInProcess ? "InProcess" : "Dds";
}

dds::DdsOptions LoopbackOptions(const std::string& tag) {
  dds::DdsOptions options;
  options.discovery_tag = tag;
  options.network_interface = "lo";
  options.self = AgentId("tester");
  return options;
}

exchange::TopicUse EveryTopic() {
  const std::vector<Topic> all = {
      Topic::kRoutes,          Topic::kSegments,       Topic::kSegmentRequests, Topic::kReceipts,
      Topic::kCatalogRequests, Topic::kCatalogReplies, Topic::kAgents,          Topic::kFleet};
  return {.write = all, .read = all};
}

bool TakeUntil(RouteExchange& exchange, const std::function<void(const Message&)>& use,
               const std::function<bool()>& done) {
  for (const auto deadline = Clock::now() + test::kLongEnough; !done();) {
    if (Clock::now() > deadline) return false;
    for (const Message& message : exchange.Take(milliseconds(20))) {
      if (!IsProbe(message)) use(message);
    }
  }
  return true;
}

bool Connect(RouteExchange& writer, Topic topic, const std::vector<RouteExchange*>& readers) {
  std::vector<bool> connected(readers.size(), false);
  for (const auto deadline = Clock::now() + test::kLongEnough; Clock::now() < deadline;) {
    if (!writer.Publish(ProbeFor(topic))) return false;
    for (std::size_t i = 0; i < readers.size(); ++i) {
      const std::vector<Message> taken = readers[i]->Take(milliseconds(connected[i] ? 0 : 20));
      if (std::any_of(taken.begin(), taken.end(), IsProbe)) connected[i] = true;
    }
    if (std::find(connected.begin(), connected.end(), false) == connected.end()) return true;
  }
  return false;
}

}  // namespace trailcast::test
