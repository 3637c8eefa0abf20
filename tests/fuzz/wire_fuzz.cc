// Samples as a middleware hands them over: whatever their fields hold, a message within bounds
// comes of them or an error, and the message goes out and comes in again as it was.
#include <fuzzer/FuzzedDataProvider.h>

#include <algorithm>
#include <deque>
#include <iterator>
#include <string>
#include <vector>

#include "services/dds/src/wire.h"
#include "services/exchange/bounds.h"
#include "services/exchange/topics.h"
#include "tests/fuzz/fuzz.h"
#include "trailcast.h"

namespace trailcast::fuzz {
namespace {

using exchange::Topic;

// Fills samples from the input and owns what they point to.
class Samples {
 public:
  explicit Samples(FuzzedDataProvider& input) : input_(input) {}

  void Fill(trailcast_wire_RouteAnnouncement& wire) {
    wire.holder = Name();
    Fill(wire.key);
    Fill(wire.info);
  }
  void Fill(trailcast_wire_SegmentBatch& wire) {
    wire.sender = Name();
    wire.pieces._length = Count();
    wire.pieces._buffer = Many<trailcast_wire_SegmentPiece>(pieces_, wire.pieces._length);
  }
  void Fill(trailcast_wire_SegmentRequest& wire) {
    wire.requester = Name();
    Fill(wire.key);
    wire.lacking._length = Count();
    wire.lacking._buffer = Numbers(wire.lacking._length);
    wire.digests_only = Octet();
  }
  void Fill(trailcast_wire_Receipt& wire) {
    wire.server = Name();
    Fill(wire.key);
    wire.durable_prefix = Number();
    wire.durable_beyond._length = Count();
    wire.durable_beyond._buffer =
        Many<trailcast_wire_NamedSegment>(named_, wire.durable_beyond._length);
    wire.revision = Number();
    wire.standing = Octet();
    wire.followed = Number();
    wire.durable_state = Octet();
    wire.refusal = Octet();
    wire.reason = Text();
  }
  void Fill(trailcast_wire_NamedSegment& wire) { wire.index = Number(); }
  void Fill(trailcast_wire_FoundPlace& wire) {
    Fill(wire.key);
    wire.segment = Number();
    wire.score = Real();
  }
  void Fill(trailcast_wire_ViewFeature& wire) {
    std::fill(std::begin(wire.descriptor), std::end(wire.descriptor), Octet());
    wire.u_sixteenth_px = static_cast<std::int32_t>(Number());
    wire.v_sixteenth_px = static_cast<std::int32_t>(Number());
  }
  void Fill(trailcast_wire_Holding& wire) {
    Fill(wire.key);
    wire.agent = Name();
  }
  void Fill(trailcast_wire_LackingSegments& wire) {
    Fill(wire.key);
    wire.segments = Number();
  }
  void Fill(trailcast_wire_RouteEditRequest& wire) {
    wire.client = Name();
    wire.request = input_.ConsumeIntegral<std::uint64_t>();
    wire.action = Octet();
    wire.route = Text();
    wire.revision = Number();
    wire.text = Text();
    FillTexts(wire.tags);
  }
  void Fill(trailcast_wire_CatalogRequest& wire) {
    trailcast_wire_CatalogQuery& query = wire.query;
    wire.client = Name();
    wire.request = input_.ConsumeIntegral<std::uint64_t>();
    for (char** text :
         {&query.name, &query.name_prefix, &query.scout, &query.camera_prefix, &query.cursor}) {
      *text = Text();
    }
    FillTexts(query.tags);
    query.min_length_m = Real();
    query.max_length_m = Real();
    query.taught_from_unix_ms = input_.ConsumeIntegral<std::int64_t>();
    query.taught_until_unix_ms = input_.ConsumeIntegral<std::int64_t>();
    query.state = Octet();
    Fill(query.near);
    query.radius_m = Real();
    query.order = Octet();
    query.page_size = Number();
    query.standing = Octet();
    query.view._length = Count();
    query.view._buffer = Many<trailcast_wire_ViewFeature>(view_, query.view._length);
  }
  void Fill(trailcast_wire_CatalogReply& wire) {
    wire.server = Name();
    wire.client = Name();
    wire.request = input_.ConsumeIntegral<std::uint64_t>();
    wire.routes._length = Count();
    wire.routes._buffer = Many<trailcast_wire_CatalogRoute>(routes_, wire.routes._length);
    wire.total = input_.ConsumeIntegral<std::uint64_t>();
    wire.next = Text();
    FillTexts(wire.similar_names);
    wire.error = Text();
    wire.places._length = Count();
    wire.places._buffer = Many<trailcast_wire_FoundPlace>(places_, wire.places._length);
    wire.holdings._length = Count();
    wire.holdings._buffer = Many<trailcast_wire_Holding>(holdings_, wire.holdings._length);
    wire.lacking._length = Count();
    wire.lacking._buffer = Many<trailcast_wire_LackingSegments>(lacking_, wire.lacking._length);
  }
  void Fill(trailcast_wire_AgentStatus& wire) {
    wire.agent = Name();
    wire.instance = input_.ConsumeIntegral<std::uint64_t>();
    wire.role = Octet();
    wire.mode = Octet();
    wire.route = Text();
    wire.segment = Number();
    wire.segments = Number();
    wire.progress = Real();
    wire.speed_mps = Real();
    wire.features = Number();
    wire.found_share = Real();
    wire.backlog = Number();
    wire.detail = Text();
    wire.held._length = Count();
    wire.held._buffer = Many<trailcast_wire_RouteKey>(keys_, wire.held._length);
    Fill(wire.on);
    wire.along_m = Real();
    wire.left_m = Real();
    wire.left_sigma_m = Real();
    wire.hold = Octet();
    wire.on_duty = Octet();
    wire.battery_percent = Octet();
    wire.link_percent = Octet();
    wire.software = Text();
    wire.carried_by = Octet();
    wire.odometry_percent = Octet();
    wire.odometry_scale = Real();
  }
  void Fill(trailcast_wire_DriveCommand& wire) {
    wire.agent = Name();
    wire.client = Name();
    wire.linear_mps = Real();
    wire.turn_radps = Real();
    wire.sent_ms = input_.ConsumeIntegral<std::uint64_t>();
  }
  void Fill(trailcast_wire_SnapshotRequest& wire) {
    wire.agent = Name();
    wire.client = Name();
    wire.request = input_.ConsumeIntegral<std::uint64_t>();
  }
  void Fill(trailcast_wire_Snapshot& wire) {
    wire.agent = Name();
    wire.client = Name();
    wire.request = input_.ConsumeIntegral<std::uint64_t>();
    picture_ = input_.ConsumeBytes<std::uint8_t>(Count());
    wire.picture._buffer = picture_.data();
    wire.picture._length = static_cast<std::uint32_t>(picture_.size());
    wire.marked = Octet();
    wire.detail = Text();
  }
  void Fill(trailcast_wire_PhotoPiece& wire) {
    wire.holder = Name();
    wire.client = Name();
    wire.photo = Name();
    wire.words = Text();
    wire.offset = input_.ConsumeIntegral<std::uint32_t>();
    picture_ = input_.ConsumeBytes<std::uint8_t>(Count());
    wire.bytes._buffer = picture_.data();
    wire.bytes._length = static_cast<std::uint32_t>(picture_.size());
    wire.error = Text();
  }
  void Fill(trailcast_wire_PhotoRequest& wire) {
    wire.client = Name();
    wire.holder = Name();
    wire.photo = Name();
    wire.offset = input_.ConsumeIntegral<std::uint32_t>();
    wire.kept = Octet();
    wire.refusal = Text();
  }
  void Fill(trailcast_wire_NetworkEdit& wire) {
    wire.client = Name();
    wire.request = input_.ConsumeIntegral<std::uint64_t>();
    wire.words = Text();
  }
  void Fill(trailcast_wire_NetworkRequest& wire) {
    wire.client = Name();
    wire.request = input_.ConsumeIntegral<std::uint64_t>();
    wire.words = Text();
    wire.first = Number();
  }
  void Fill(trailcast_wire_NetworkReply& wire) {
    wire.server = Name();
    wire.client = Name();
    wire.request = input_.ConsumeIntegral<std::uint64_t>();
    FillTexts(wire.lines);
    wire.next = Number();
    wire.error = Text();
  }
  void Fill(trailcast_wire_Fleet& wire) {
    wire.server = Name();
    wire.agents = Number();
    wire.claimed._length = Count();
    wire.claimed._buffer = Many<trailcast_wire_ClaimedName>(claimed_, wire.claimed._length);
  }
  void Fill(trailcast_wire_ClaimedName& wire) {
    wire.agent = Name();
    wire.claims = input_.ConsumeIntegral<std::uint64_t>();
    wire.keeps = input_.ConsumeIntegral<std::uint64_t>();
  }
  void Fill(trailcast_wire_RouteFollowers& wire) {
    wire.server = Name();
    Fill(wire.key);
    wire.followers._length = Count();
    wire.followers._buffer = Many<trailcast_wire_RouteFollower>(followers_, wire.followers._length);
  }
  void Fill(trailcast_wire_FollowedSections& wire) {
    wire.agent = Name();
    Fill(wire.on);
    wire.sections._length = Count();
    wire.sections._buffer = Many<trailcast_wire_FollowedSection>(sections_, wire.sections._length);
  }
  void Fill(trailcast_wire_FollowedSection& wire) {
    wire.number = input_.ConsumeIntegral<std::uint32_t>();
    wire.passed = input_.ConsumeIntegral<std::uint32_t>();
    wire.lost = input_.ConsumeIntegral<std::uint32_t>();
  }
  void Fill(trailcast_wire_ReachRequest& wire) {
    wire.client = Name();
    wire.request = input_.ConsumeIntegral<std::uint64_t>();
    wire.relayed = Octet();
    wire.server = Name();
  }
  void Fill(trailcast_wire_ReachReport& wire) {
    wire.agent = Name();
    wire.client = Name();
    wire.request = input_.ConsumeIntegral<std::uint64_t>();
    wire.server = Name();
    wire.role = Octet();
    wire.star = Octet();
    wire.heard._length = Count();
    wire.heard._buffer = Many<trailcast_wire_HeardAgent>(heard_, wire.heard._length);
    wire.before = Number();
    wire.relayed = Octet();
  }
  void Fill(trailcast_wire_HeardAgent& wire) {
    wire.agent = Name();
    wire.role = Octet();
    wire.heard_for_ms = Number();
    wire.age_ms = Number();
    wire.late_ms = Real();
    wire.round_trip_ms = Real();
    wire.address = Text();
    wire.network = Text();
  }
  void Fill(trailcast_wire_StoreSummary& wire) {
    wire.server = Name();
    wire.prefix = Text();
    wire.parts._length = Count();
    wire.parts._buffer = Many<std::uint64_t>(parts_, wire.parts._length);
    wire.entries._length = Count();
    wire.entries._buffer = Many<trailcast_wire_StoreEntry>(entries_, wire.entries._length);
  }
  void Fill(trailcast_wire_StoreEntry& wire) {
    Fill(wire.of);
    wire.digest = input_.ConsumeIntegral<std::uint64_t>();
  }
  void Fill(std::uint64_t& part) { part = input_.ConsumeIntegral<std::uint64_t>(); }
  void Fill(trailcast_wire_NowCommand& wire) {
    wire.client = Name();
    wire.number = input_.ConsumeIntegral<std::uint64_t>();
    wire.order = Octet();
    wire.whom = Octet();
    wire.name = Name();
    wire.reason = Text();
    wire.relayed = Octet();
  }
  void Fill(trailcast_wire_Mission& wire) {
    wire.agent = Name();
    wire.id = Name();
    wire.client = Name();
    wire.orders = Text();
    wire.valid_for_s = Number();
    wire.goes_on = Octet();
    wire.relayed = Octet();
  }
  void Fill(trailcast_wire_MissionReport& wire) {
    wire.agent = Name();
    wire.id = Name();
    wire.change = Number();
    wire.state = Octet();
    wire.task = Number();
    wire.way = Number();
    wire.waits_for = Octet();
    wire.detail = Text();
    wire.relayed = Octet();
  }
  void Fill(trailcast_wire_MissionRequest& wire) {
    wire.client = Name();
    wire.request = input_.ConsumeIntegral<std::uint64_t>();
    wire.commands = Octet();
    for (char** text : {&wire.query.agent, &wire.query.route, &wire.query.id, &wire.query.client}) {
      *text = Name();
    }
    wire.query.states = Number();
    wire.query.from_unix_ms = input_.ConsumeIntegral<std::int64_t>();
    wire.query.until_unix_ms = input_.ConsumeIntegral<std::int64_t>();
    wire.query.page_size = Number();
    wire.query.before = input_.ConsumeIntegral<std::uint64_t>();
  }
  void Fill(trailcast_wire_MissionRecord& wire) {
    Fill(wire.sent);
    Fill(wire.last);
    wire.sent_unix_ms = input_.ConsumeIntegral<std::int64_t>();
    wire.changed_unix_ms = input_.ConsumeIntegral<std::int64_t>();
  }
  void Fill(trailcast_wire_GivenCommand& wire) {
    Fill(wire.given);
    wire.answers._length = Count();
    wire.answers._buffer = Many<trailcast_wire_NowAnswer>(answers_, wire.answers._length);
    wire.given_unix_ms = input_.ConsumeIntegral<std::int64_t>();
  }
  void Fill(trailcast_wire_MissionReply& wire) {
    wire.server = Name();
    wire.client = Name();
    wire.request = input_.ConsumeIntegral<std::uint64_t>();
    wire.missions._length = Count();
    wire.missions._buffer = Many<trailcast_wire_MissionRecord>(missions_, wire.missions._length);
    wire.commands._length = Count();
    wire.commands._buffer = Many<trailcast_wire_GivenCommand>(commands_, wire.commands._length);
    FillTexts(wire.robots);
    wire.next = input_.ConsumeIntegral<std::uint64_t>();
    wire.error = Text();
  }
  void Fill(trailcast_wire_NowAnswer& wire) {
    wire.agent = Name();
    wire.client = Name();
    wire.number = input_.ConsumeIntegral<std::uint64_t>();
    wire.refused = Octet();
    wire.detail = Text();
    wire.relayed = Octet();
  }
  void Fill(trailcast_wire_RouteFollower& wire) {
    wire.agent = Name();
    wire.along_m = Real();
    wire.speed_mps = Real();
    wire.heard = Octet();
    wire.age_ms = Number();
  }

 private:
  void Fill(trailcast_wire_RouteKey& wire) {
    wire.route = input_.ConsumeBool() ? Keep(std::string(32, 'a')) : Text();
    wire.teaching = input_.ConsumeIntegral<std::uint64_t>();
  }
  void Fill(trailcast_wire_RoutePlace& wire) {
    wire.frame = Octet();
    wire.x = Real();
    wire.y = Real();
  }
  void Fill(trailcast_wire_RouteInfo& wire) {
    wire.name = Name();
    wire.scout = Name();
    wire.camera = Text();
    wire.image_width_px = Number();
    wire.image_height_px = Number();
    wire.taught_unix_ms = input_.ConsumeIntegral<std::int64_t>();
    wire.state = Octet();
    wire.segment_count = Number();
    wire.length_m = Real();
    wire.bytes = input_.ConsumeIntegral<std::uint64_t>();
    Fill(wire.manifest_digest);
    FillTexts(wire.tags);
    Fill(wire.place);
    wire.description = Text();
    wire.standing = Octet();
    wire.to_review = Octet();
    wire.edition = Number();
    wire.refreshes = Number();
  }
  void Fill(trailcast_wire_SegmentPiece& wire) {
    Fill(wire.key);
    wire.index = Number();
    Fill(wire.digest);
    const std::vector<std::uint8_t>& bytes =
        bytes_.emplace_back(input_.ConsumeBytes<std::uint8_t>(Octet()));
    wire.bytes._length = static_cast<std::uint32_t>(bytes.size());
    wire.bytes._buffer = const_cast<std::uint8_t*>(bytes.data());
  }
  void Fill(trailcast_wire_CatalogRoute& wire) {
    Fill(wire.key);
    Fill(wire.info);
  }
  void Fill(trailcast_wire_Sha256& digest) {
    std::fill(std::begin(digest), std::end(digest), Octet());
  }
  template <typename Sequence>
  void FillTexts(Sequence& sequence) {
    sequence._length = Count();
    std::vector<char*>& texts = text_lists_.emplace_back();
    for (std::uint32_t i = 0; i < sequence._length; ++i) texts.push_back(Name());
    sequence._buffer = texts.data();
  }
  template <typename Wire>
  Wire* Many(std::deque<std::vector<Wire>>& owner, std::uint32_t count) {
    std::vector<Wire>& wires = owner.emplace_back(count);
    for (Wire& wire : wires) Fill(wire);
    return wires.data();
  }
  std::uint32_t* Numbers(std::uint32_t count) {
    std::vector<std::uint32_t>& numbers = numbers_.emplace_back();
    for (std::uint32_t i = 0; i < count; ++i) numbers.push_back(Number());
    return numbers.data();
  }

  std::uint32_t Count() { return input_.ConsumeIntegralInRange<std::uint32_t>(0, 20); }
  std::uint8_t Octet() {
    return input_.ConsumeBool() ? input_.ConsumeIntegralInRange<std::uint8_t>(0, 6)
                                : input_.ConsumeIntegral<std::uint8_t>();
  }
  std::uint32_t Number() {
    return input_.ConsumeBool() ? Octet() : input_.ConsumeIntegral<std::uint32_t>();
  }
  double Real() {
    return input_.ConsumeBool() ? Octet() / 8.0 : input_.ConsumeFloatingPoint<double>();
  }
  // Most of the time one that is accepted, so that the rest of a sample is looked at too.
  char* Name() {
    return input_.ConsumeIntegral<std::uint8_t>() < 224 ? Keep(std::string(1 + Count() % 4, 'b'))
                                                        : Text();
  }
  char* Text() {
    if (input_.ConsumeIntegral<std::uint8_t>() == 255) return nullptr;
    return Keep(input_.ConsumeRandomLengthString(600));
  }
  char* Keep(std::string text) { return texts_.emplace_back(std::move(text)).data(); }

  FuzzedDataProvider& input_;
  std::deque<std::string> texts_;
  std::deque<std::vector<char*>> text_lists_;
  std::deque<std::vector<std::uint32_t>> numbers_;
  std::vector<std::uint8_t> picture_;
  std::deque<std::vector<std::uint8_t>> bytes_;
  std::deque<std::vector<trailcast_wire_SegmentPiece>> pieces_;
  std::deque<std::vector<trailcast_wire_CatalogRoute>> routes_;
  std::deque<std::vector<trailcast_wire_FoundPlace>> places_;
  std::deque<std::vector<trailcast_wire_Holding>> holdings_;
  std::deque<std::vector<trailcast_wire_LackingSegments>> lacking_;
  std::deque<std::vector<trailcast_wire_NamedSegment>> named_;
  std::deque<std::vector<trailcast_wire_RouteKey>> keys_;
  std::deque<std::vector<trailcast_wire_ViewFeature>> view_;
  std::deque<std::vector<trailcast_wire_ClaimedName>> claimed_;
  std::deque<std::vector<trailcast_wire_RouteFollower>> followers_;
  std::deque<std::vector<trailcast_wire_FollowedSection>> sections_;
  std::deque<std::vector<trailcast_wire_MissionRecord>> missions_;
  std::deque<std::vector<trailcast_wire_GivenCommand>> commands_;
  std::deque<std::vector<trailcast_wire_NowAnswer>> answers_;
  std::deque<std::vector<trailcast_wire_HeardAgent>> heard_;
  std::deque<std::vector<std::uint64_t>> parts_;
  std::deque<std::vector<trailcast_wire_StoreEntry>> entries_;
};

// A query is judged when it is answered; one with no number in it equals nothing, itself included.
bool IsComparable(const exchange::Message& message) {
  const auto* request = std::get_if<exchange::CatalogRequest>(&message);
  return request == nullptr || exchange::CheckQuery(request->query);
}

void TakeIn(Topic topic, const void* sample) {
  const auto message = dds::FromWire(topic, sample);
  if (!message) return;
  Require(exchange::CheckBounds(*message).has_value(), "what is taken in is within bounds");
  Require(exchange::TopicOf(*message) == topic, "it is of its topic");
  if (!IsComparable(*message)) return;
  const auto gone_out = dds::WithWire(*message, [&](const void* out) -> Result<void> {
    const auto again = dds::FromWire(topic, out);
    Require(again && *again == *message, "what goes out comes in as it was");
    return {};
  });
  Require(gone_out.has_value(), "what is taken in can be sent");
}

template <typename Wire>
void FillAndTakeIn(Topic topic, FuzzedDataProvider& input) {
  Samples samples(input);
  Wire wire{};
  samples.Fill(wire);
  TakeIn(topic, &wire);
  if constexpr (std::is_same_v<Wire, trailcast_wire_AgentStatus>) {
    const auto gone = dds::GoneFromWire(&wire);
    Require(!gone || IsValidName(gone->agent.value()), "who is gone has a name");
  }
}

}  // namespace
}  // namespace trailcast::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace trailcast::fuzz;
  FuzzedDataProvider input(data, size);
  switch (const auto topic = static_cast<Topic>(input.ConsumeIntegralInRange<int>(0, 18))) {
    case Topic::kRoutes:
      FillAndTakeIn<trailcast_wire_RouteAnnouncement>(topic, input);
      break;
    case Topic::kSegments:
      FillAndTakeIn<trailcast_wire_SegmentBatch>(topic, input);
      break;
    case Topic::kSegmentRequests:
      FillAndTakeIn<trailcast_wire_SegmentRequest>(topic, input);
      break;
    case Topic::kReceipts:
      FillAndTakeIn<trailcast_wire_Receipt>(topic, input);
      break;
    case Topic::kCatalogRequests:
      FillAndTakeIn<trailcast_wire_CatalogRequest>(topic, input);
      break;
    case Topic::kCatalogReplies:
      FillAndTakeIn<trailcast_wire_CatalogReply>(topic, input);
      break;
    case Topic::kAgents:
      FillAndTakeIn<trailcast_wire_AgentStatus>(topic, input);
      break;
    case Topic::kRouteEdits:
      FillAndTakeIn<trailcast_wire_RouteEditRequest>(topic, input);
      break;
    case Topic::kFleet:
      FillAndTakeIn<trailcast_wire_Fleet>(topic, input);
      break;
    case Topic::kNeighbours:
      FillAndTakeIn<trailcast_wire_RouteFollowers>(topic, input);
      break;
    case Topic::kNow:
      FillAndTakeIn<trailcast_wire_NowCommand>(topic, input);
      break;
    case Topic::kNowAnswers:
      FillAndTakeIn<trailcast_wire_NowAnswer>(topic, input);
      break;
    case Topic::kMissions:
      FillAndTakeIn<trailcast_wire_Mission>(topic, input);
      break;
    case Topic::kMissionStates:
      FillAndTakeIn<trailcast_wire_MissionReport>(topic, input);
      break;
    case Topic::kMissionRequests:
      FillAndTakeIn<trailcast_wire_MissionRequest>(topic, input);
      break;
    case Topic::kMissionReplies:
      FillAndTakeIn<trailcast_wire_MissionReply>(topic, input);
      break;
    case Topic::kDrives:
      FillAndTakeIn<trailcast_wire_DriveCommand>(topic, input);
      break;
    case Topic::kSnapshotRequests:
      FillAndTakeIn<trailcast_wire_SnapshotRequest>(topic, input);
      break;
    case Topic::kSnapshots:
      FillAndTakeIn<trailcast_wire_Snapshot>(topic, input);
      break;
    case Topic::kNetworkEdits:
      FillAndTakeIn<trailcast_wire_NetworkEdit>(topic, input);
      break;
    case Topic::kNetworkRequests:
      FillAndTakeIn<trailcast_wire_NetworkRequest>(topic, input);
      break;
    case Topic::kNetworkReplies:
      FillAndTakeIn<trailcast_wire_NetworkReply>(topic, input);
      break;
    case Topic::kFollowed:
      FillAndTakeIn<trailcast_wire_FollowedSections>(topic, input);
      break;
    case Topic::kReachRequests:
      FillAndTakeIn<trailcast_wire_ReachRequest>(topic, input);
      break;
    case Topic::kReachReports:
      FillAndTakeIn<trailcast_wire_ReachReport>(topic, input);
      break;
    case Topic::kStores:
      FillAndTakeIn<trailcast_wire_StoreSummary>(topic, input);
      break;
    case Topic::kPhotos:
      FillAndTakeIn<trailcast_wire_PhotoPiece>(topic, input);
      break;
    case Topic::kPhotoRequests:
      FillAndTakeIn<trailcast_wire_PhotoRequest>(topic, input);
      break;
  }
  return 0;
}
