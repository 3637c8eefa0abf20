#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "services/exchange/bounds.h"
#include "tests/contract/network.h"
#include "tests/support/pieces.h"

namespace trailcast::exchange {
namespace {

using route::RouteState;
using test::Connect;
using test::EveryTopic;
using test::KeyNumber;
using test::TakeUntil;

class RouteExchangeContract : public testing::TestWithParam<test::NetworkKind> {
 protected:
  std::unique_ptr<RouteExchange> Open(const TopicUse& use) { return network_->Open(use); }
  std::unique_ptr<RouteExchange> Open() { return Open(EveryTopic()); }

  // Returns what `reader` gets when `writer`, known to it, publishes `message`.
  static std::vector<Message> Carry(const Message& message, RouteExchange& writer,
                                    RouteExchange& reader, Topic topic) {
    EXPECT_TRUE(Connect(writer, topic, {&reader}));
    const auto published = writer.Publish(message);
    EXPECT_TRUE(published) << published.error().message;
    std::vector<Message> got;
    EXPECT_TRUE(TakeUntil(
        reader, [&](const Message& one) { got.push_back(one); }, [&] { return !got.empty(); }));
    return got;
  }

  void ExpectRoundTrip(const Message& message, Topic topic) {
    const auto writer = Open({.write = {topic}, .read = {}});
    const auto reader = Open({.write = {}, .read = {topic}});
    EXPECT_EQ(Carry(message, *writer, *reader, topic), std::vector<Message>{message});
    EXPECT_EQ(reader->dropped(), 0U);
  }

  static AgentStatus Status(const std::string& agent, std::uint64_t instance) {
    return {.agent = AgentId(agent), .instance = instance, .role = AgentRole::kScout};
  }

 private:
  std::unique_ptr<test::Network> network_ = test::MakeNetwork(GetParam());
};

route::RouteInfo ExtremeInfo() {
  route::RouteInfo info = test::InfoOf(KeyNumber(7, 0xFFFFFFFF), {}, RouteState::kComplete);
  info.name = std::string(64, 'x');
  info.scout = AgentId(std::string(64, 'Z'));
  info.camera = "f\xC3\xA4hre \xF0\x9F\x9A\xA2" + std::string(route::kMaxCameraBytes - 11, '.');
  info.image_width_px = info.image_height_px = route::kMaxImageSide_px;
  info.taught_unix_ms = std::numeric_limits<std::int64_t>::min();
  info.segment_count = route::kMaxSegmentsPerRoute;
  info.length_m = 1e7;
  info.bytes = route::kMaxRouteBytes;
  info.manifest_digest.fill(0xFF);
  for (std::size_t i = 0; i < route::kMaxTags; ++i) {
    info.tags.push_back(fmt::format("{:02}{}", i, std::string(62, 't')));
  }
  info.place = route::Place{route::Place::Frame::kSite, -1e7, 1e7};
  info.description = std::string(route::kMaxDescriptionBytes, 'd');
  info.standing = route::Standing::kRetired;
  info.to_review = true;
  info.edition = 0xFFFFFFFF;
  info.refreshes = RevisionNumber(3);
  return info;
}

TEST_P(RouteExchangeContract, CarriesAnAnnouncementOfExtremes) {
  ExpectRoundTrip(RouteAnnouncement{AgentId("a"), ExtremeInfo()}, Topic::kRoutes);
}

TEST_P(RouteExchangeContract, CarriesASegmentOfOneByte) {
  ExpectRoundTrip(SegmentBatch{AgentId("s"), {test::PieceOf(KeyNumber(1), 0, 1)}},
                  Topic::kSegments);
}

TEST_P(RouteExchangeContract, CarriesTheLargestSegmentOfTheLongestRoute) {
  const auto piece = test::PieceOf(KeyNumber(1), route::kMaxSegmentsPerRoute - 1, kMaxPieceBytes);
  ExpectRoundTrip(SegmentBatch{AgentId("s"), {piece}}, Topic::kSegments);
}

TEST_P(RouteExchangeContract, CarriesTheLongestRequest) {
  ExpectRoundTrip(
      SegmentRequest{AgentId("f"), KeyNumber(1), test::Indices(0, kMaxIndicesPerRequest)},
      Topic::kSegmentRequests);
}

TEST_P(RouteExchangeContract, CarriesTheLongestReceipt) {
  Receipt receipt = test::ReceiptFor(AgentId("s"), KeyNumber(1), test::PiecesOf(KeyNumber(1), 2), 1,
                                     test::Indices(2, 2 + kMaxSegmentsPerReceipt));
  receipt.revision = RevisionNumber(7);
  receipt.standing = route::Standing::kRetired;
  receipt.followed = RevisionNumber(9);
  ExpectRoundTrip(receipt, Topic::kReceipts);
}

TEST_P(RouteExchangeContract, CarriesCatalogRequests) {
  ExpectRoundTrip(CatalogRequest{AgentId("f"), ~0ULL, {}}, Topic::kCatalogRequests);
  const route::Place far{route::Place::Frame::kWgs84, -179.5, -89.5};
  const route::RouteQuery query{.name = "corridor",
                                .name_prefix = "corr",
                                .tags = {"night", "wet"},
                                .scout = "scout-1",
                                .camera_prefix = "webcam 320",
                                .min_length_m = 1.5,
                                .max_length_m = 1e6,
                                .taught_from_unix_ms = -1,
                                .taught_until_unix_ms = 1LL << 60,
                                .state = RouteState::kTeaching,
                                .near = route::Surroundings{far, 12.5},
                                .order = route::RouteOrder::kShortest,
                                .page_size = ~0U,
                                .cursor = std::string(kMaxCursorBytes, '/')};
  ExpectRoundTrip(CatalogRequest{AgentId("f"), 0, query}, Topic::kCatalogRequests);
}

TEST_P(RouteExchangeContract, CarriesTheLongestView) {
  route::RouteQuery query{.page_size = 3};
  for (std::size_t i = 0; i < route::kMaxViewFeatures; ++i) {
    route::ViewFeature feature{{}, 159.9375F, -65535.0F, 0.125F * static_cast<float>(i)};
    feature.descriptor.fill(static_cast<std::uint8_t>(1 + i % 255));
    query.view.push_back(feature);
  }
  ExpectRoundTrip(CatalogRequest{AgentId("f"), 1, query}, Topic::kCatalogRequests);
}

TEST_P(RouteExchangeContract, CarriesPlacesAndHowMuchWasSearched) {
  CatalogReply reply{AgentId("s"), AgentId("f"), 1, {}, {}, {}};
  reply.places.assign(kMaxPlacesPerReply,
                      {KeyNumber(1), SegmentIndex(route::kMaxSegmentsPerRoute - 1), 1.0});
  reply.coverage = {1ULL << 40U, ~0ULL, 7};
  ExpectRoundTrip(reply, Topic::kCatalogReplies);
}

TEST_P(RouteExchangeContract, CarriesTheLongestCatalogReply) {
  CatalogReply reply{AgentId("s"), AgentId("f"), ~0ULL, {}, {}, std::string(kMaxLineBytes, 'e')};
  reply.page = {std::vector(kMaxRoutesPerReply, ExtremeInfo()), ~0ULL,
                std::string(kMaxCursorBytes, '/')};
  reply.similar_names.assign(kMaxSimilarNames, std::string(64, 'n'));
  reply.lacking.assign(kMaxRoutesPerReply, {KeyNumber(9), route::kMaxSegmentsPerRoute});
  reply.holdings.assign(exchange::kMaxHoldingsPerReply,
                        {KeyNumber(7, 0xFFFFFFFF), AgentId(std::string(64, 'h'))});
  ExpectRoundTrip(reply, Topic::kCatalogReplies);
}

TEST_P(RouteExchangeContract, CarriesAStatusOfExtremes) {
  const AgentStatus status{
      .agent = AgentId("a"),
      .instance = ~0ULL,
      .role = AgentRole::kOperator,
      .mode = AgentMode::kFault,
      .route = "corridor",
      .segment = ~0U,
      .segments = ~0U,
      .progress = 1.0,
      .speed_mps = -1000.0,
      .features = ~0U,
      .found_share = 1.0,
      .backlog = ~0U,
      .detail = std::string(kMaxLineBytes, 'd'),
      .held = std::vector(exchange::kMaxHeldTold, KeyNumber(7)),
      .place = exchange::PlaceOnRoute{KeyNumber(7, ~0U), 1e7, -1e3, 1e3},
      .hold = exchange::AgentHold::kStopped,
      .on_duty = true,
      .battery_percent = 100,
      .link_percent = 0,
      .software = std::string(exchange::kMaxSoftwareBytes, 's'),
      .following = exchange::Following{exchange::CarriedBy::kMotion,
                                       exchange::OdometryTrust{100, exchange::kMaxOdometryScale}}};
  ExpectRoundTrip(status, Topic::kAgents);
  ExpectRoundTrip(
      AgentStatus{.agent = AgentId("by-camera"),
                  .following = exchange::Following{exchange::CarriedBy::kNothing, std::nullopt}},
      Topic::kAgents);
  ExpectRoundTrip(AgentStatus{.agent = AgentId("nowhere")}, Topic::kAgents);
}

TEST_P(RouteExchangeContract, CarriesWhatIsToldOfTheLargestFleet) {
  exchange::Fleet fleet{.server = AgentId("s"), .agents = ~0U, .claimed = {}};
  fleet.claimed.assign(exchange::kMaxClaimedNames, {AgentId(std::string(64, 'n')), ~0ULL, 1});
  ExpectRoundTrip(fleet, Topic::kFleet);
}

TEST_P(RouteExchangeContract, CarriesAnEditOfExtremes) {
  const route::RouteEdit edit{.action = route::EditAction::kDelete,
                              .route = std::string(64, 'x'),
                              .revision = ~0U,
                              .text = std::string(kMaxLineBytes, 't'),
                              .tags = std::vector(route::kMaxTags, std::string(64, 't'))};
  ExpectRoundTrip(exchange::RouteEditRequest{AgentId("o"), ~0ULL, edit}, Topic::kRouteEdits);
}

TEST_P(RouteExchangeContract, CarriesHowARobotIsDriven) {
  ExpectRoundTrip(exchange::DriveCommand{.agent = AgentId("r"),
                                         .client = AgentId("o"),
                                         .linear_mps = -0.5,
                                         .turn_radps = 1.5,
                                         .sent_ms = ~0ULL},
                  Topic::kDrives);
}

TEST_P(RouteExchangeContract, CarriesTheLargestSnapshot) {
  ExpectRoundTrip(exchange::SnapshotRequest{AgentId("r"), AgentId("o"), ~0ULL},
                  Topic::kSnapshotRequests);
  ExpectRoundTrip(exchange::Snapshot{.agent = AgentId("r"),
                                     .client = AgentId("o"),
                                     .request = ~0ULL,
                                     .picture = std::vector<std::uint8_t>(
                                         exchange::kMaxSnapshotBytes, std::uint8_t{0xA5}),
                                     .marked = true},
                  Topic::kSnapshots);
}

TEST_P(RouteExchangeContract, CarriesTheLargestPieceOfAPhoto) {
  ExpectRoundTrip(exchange::PhotoPiece{.holder = AgentId("r"),
                                       .client = AgentId("s"),
                                       .photo = "4f2a",
                                       .words = std::string(exchange::kMaxLineBytes, 'w'),
                                       .offset = exchange::kMaxPhotoBytes,
                                       .bytes = std::vector<std::uint8_t>(
                                           exchange::kMaxPhotoPieceBytes, std::uint8_t{0xA5}),
                                       .error = "none"},
                  Topic::kPhotos);
  ExpectRoundTrip(exchange::PhotoRequest{.client = AgentId("s"),
                                         .holder = AgentId("r"),
                                         .photo = "4f2a",
                                         .offset = 7,
                                         .kept = true,
                                         .refusal = "full"},
                  Topic::kPhotoRequests);
}

TEST_P(RouteExchangeContract, CarriesWhoHearsWhom) {
  ExpectRoundTrip(exchange::ReachRequest{AgentId("o"), ~0ULL, true, AgentId("s")},
                  Topic::kReachRequests);
  const exchange::HeardAgent heard{.agent = AgentId(std::string(64, 'r')),
                                   .role = exchange::AgentRole::kScout,
                                   .heard_for = std::chrono::milliseconds(~0U),
                                   .age = std::chrono::milliseconds(1),
                                   .late_ms = -exchange::kMaxLate_ms,
                                   .round_trip_ms = exchange::kMaxLate_ms,
                                   .address = std::string(exchange::kMaxAddressBytes, '1'),
                                   .network = std::string(exchange::kMaxNetworkBytes, 'w')};
  exchange::ReachReport report{
      .agent = AgentId("r"),
      .client = AgentId("o"),
      .request = ~0ULL,
      .server = AgentId("s"),
      .role = exchange::AgentRole::kServer,
      .star = true,
      .heard = std::vector<exchange::HeardAgent>(exchange::kMaxHeardAgents, heard),
      .before = ~0U,
      .relayed = true};
  report.heard.back().round_trip_ms.reset();
  ExpectRoundTrip(report, Topic::kReachReports);
}

TEST_P(RouteExchangeContract, SummariesOfStoresArriveAsTheyWere) {
  exchange::StoreSummary summary{.server = AgentId("site-a"), .prefix = "a3"};
  summary.parts.assign(256, ~0ULL);
  summary.parts[7] = 0;
  ExpectRoundTrip(summary, Topic::kStores);
  summary.parts.clear();
  summary.entries = {{KeyNumber(1, 7), 1}, {KeyNumber(2, (1ULL << 63U) - 1), ~0ULL}};
  ExpectRoundTrip(summary, Topic::kStores);
}

TEST_P(RouteExchangeContract, CarriesWhatBecameOfAMission) {
  ExpectRoundTrip(mission::Report{.agent = AgentId("r"),
                                  .mission = std::string(64, 'm'),
                                  .change = ~0U,
                                  .state = mission::State::kExpired,
                                  .task = ~0U,
                                  .way = ~0U,
                                  .waits_for = mission::WaitsFor::kPlace,
                                  .detail = std::string(kMaxLineBytes, 'd'),
                                  .relayed = true},
                  Topic::kMissionStates);
}

TEST_P(RouteExchangeContract, CarriesWordsOfTheNetwork) {
  const std::string words(kMaxLineBytes, 'w');
  ExpectRoundTrip(exchange::NetworkEdit{AgentId("o"), ~0ULL, words}, Topic::kNetworkEdits);
  ExpectRoundTrip(exchange::NetworkRequest{AgentId("o"), ~0ULL, words, ~0U},
                  Topic::kNetworkRequests);
  ExpectRoundTrip(exchange::NetworkReply{.server = AgentId("s"),
                                         .client = AgentId("o"),
                                         .request = ~0ULL,
                                         .lines = std::vector(exchange::kMaxNetworkLines, words),
                                         .next = ~0U,
                                         .error = words},
                  Topic::kNetworkReplies);
}

TEST_P(RouteExchangeContract, CarriesHowSectionsWereFollowed) {
  constexpr std::uint32_t kMost = exchange::kMaxTimesPassed;
  ExpectRoundTrip(
      exchange::FollowedSections{
          .agent = AgentId("r"),
          .key = KeyNumber(1),
          .sections = std::vector(exchange::kMaxSectionsTold,
                                  exchange::FollowedSections::Section{7, kMost, kMost})},
      Topic::kFollowed);
}

TEST_P(RouteExchangeContract, CarriesARefusal) {
  Receipt receipt{.server = AgentId("s"), .key = KeyNumber(1)};
  receipt.refusal = exchange::Refusal::kFull;
  receipt.reason = std::string(kMaxLineBytes, 'r');
  ExpectRoundTrip(receipt, Topic::kReceipts);
}

TEST_P(RouteExchangeContract, DeliversFiveHundredSegmentsToTwoReadersInOrder) {
  const auto scout = Open(ScoutTopics());
  const auto server = Open(ServerTopics());
  const auto follower = Open(FollowerTopics());
  ASSERT_TRUE(follower->Listen(Topic::kSegments, {KeyNumber(1), test::ProbeRoute()}));
  ASSERT_TRUE(Connect(*scout, Topic::kSegments, {server.get(), follower.get()}));
  const auto sent = test::PiecesOf(KeyNumber(1), 500, 4096);
  ASSERT_TRUE(scout->Publish(SegmentBatch{AgentId("scout-1"), sent}));
  for (RouteExchange* reader : {server.get(), follower.get()}) {
    std::vector<route::SegmentPiece> got;
    const auto keep = [&](const Message& message) {
      const auto& pieces = std::get<SegmentBatch>(message).pieces;
      got.insert(got.end(), pieces.begin(), pieces.end());
    };
    ASSERT_TRUE(TakeUntil(*reader, keep, [&] { return got.size() >= sent.size(); }));
    EXPECT_TRUE(got == sent);
  }
}

TEST_P(RouteExchangeContract, SplitsALargeBatchIntoSamplesOfModestSize) {
  const auto writer = Open();
  const auto reader = Open();
  ASSERT_TRUE(Connect(*writer, Topic::kSegments, {reader.get()}));
  ASSERT_TRUE(writer->Publish(SegmentBatch{AgentId("s"), test::PiecesOf(KeyNumber(1), 64, 4096)}));
  std::size_t count = 0;
  const auto check = [&](const Message& message) {
    std::size_t bytes = 0;
    for (const auto& piece : std::get<SegmentBatch>(message).pieces) bytes += piece.bytes.size();
    EXPECT_LE(bytes, 64U << 10U);
    count += std::get<SegmentBatch>(message).pieces.size();
  };
  EXPECT_TRUE(TakeUntil(*reader, check, [&] { return count == 64; }));
}

TEST_P(RouteExchangeContract, GivesALateJoinerTheLatestPerKey) {
  const auto writer = Open();
  const auto pieces = test::PiecesOf(KeyNumber(1), 3);
  const std::span all(pieces);
  const RouteAnnouncement old{AgentId("s"),
                              test::InfoOf(KeyNumber(1), all.first(2), RouteState::kTeaching)};
  const RouteAnnouncement latest{AgentId("s"),
                                 test::InfoOf(KeyNumber(1), all, RouteState::kComplete)};
  const RouteAnnouncement other{AgentId("s"),
                                test::InfoOf(KeyNumber(2), {}, RouteState::kTeaching)};
  const RouteAnnouncement elsewhere{AgentId("t"), old.info};
  const Receipt receipt =
      test::ReceiptFor(AgentId("s"), KeyNumber(1), pieces, 3, {}, RouteState::kComplete);
  for (const Message& message : std::vector<Message>{old, other, elsewhere, latest, receipt,
                                                     Status("s", 1), Status("s", 2)}) {
    ASSERT_TRUE(writer->Publish(message));
  }
  const auto late = Open();
  std::vector<Message> got;
  ASSERT_TRUE(TakeUntil(
      *late, [&](const Message& message) { got.push_back(message); },
      [&] { return got.size() >= 6; }));
  EXPECT_THAT(got, testing::UnorderedElementsAre(Message(other), Message(elsewhere),
                                                 Message(latest), Message(receipt),
                                                 Message(Status("s", 1)), Message(Status("s", 2))));
}

TEST_P(RouteExchangeContract, NeverReturnsOwnMessages) {
  const auto self = Open();
  const auto other = Open();
  ASSERT_TRUE(Connect(*self, Topic::kAgents, {other.get()}));
  ASSERT_TRUE(Connect(*other, Topic::kAgents, {self.get()}));
  ASSERT_TRUE(self->Publish(Status("self", 1)));
  ASSERT_TRUE(other->Publish(Status("other", 1)));
  std::vector<Message> got;
  ASSERT_TRUE(TakeUntil(
      *self, [&](const Message& message) { got.push_back(message); },
      [&] { return !got.empty(); }));
  EXPECT_EQ(got, std::vector<Message>{Status("other", 1)});
}

TEST_P(RouteExchangeContract, KeepsTheOrderOfRequestsOfSeveralAgents) {
  const auto writer = Open();
  const auto reader = Open();
  ASSERT_TRUE(Connect(*writer, Topic::kCatalogRequests, {reader.get()}));
  std::vector<std::uint64_t> got;
  for (std::uint64_t i = 0; i < 12; ++i) {
    ASSERT_TRUE(writer->Publish(CatalogRequest{AgentId(i % 2 == 0 ? "even" : "odd"), i, {}}));
  }
  ASSERT_TRUE(TakeUntil(
      *reader,
      [&](const Message& message) { got.push_back(std::get<CatalogRequest>(message).request); },
      [&] { return got.size() >= 12; }));
  EXPECT_TRUE(std::is_sorted(got.begin(), got.end())) << testing::PrintToString(got);
}

TEST_P(RouteExchangeContract, TellsWhoOverhearsWhatIsSaidFromThenOn) {
  const auto agent = Open({.write = {Topic::kAgents}, .read = {}});
  ASSERT_TRUE(agent->Publish(Status("before", 1)));
  const auto other = Open({.write = {}, .read = {}, .overhear = {Topic::kAgents}});
  const Message after = Status("after", 1);
  EXPECT_EQ(Carry(after, *agent, *other, Topic::kAgents), std::vector<Message>{after});
}

TEST_P(RouteExchangeContract, TellsWhoOverhearsThatAnAgentIsGone) {
  const auto other = Open({.write = {}, .read = {}, .overhear = {Topic::kAgents}});
  auto agent = Open({.write = {Topic::kAgents}, .read = {}});
  Carry(Status("scout", 1), *agent, *other, Topic::kAgents);
  agent.reset();
  bool gone = false;
  EXPECT_TRUE(TakeUntil(
      *other,
      [&](const Message& message) {
        gone |= message == Message(AgentGone{AgentId("scout"), 1});
      },
      [&] { return gone; }));
}

TEST_P(RouteExchangeContract, CarriesWhatIsRarelyWrittenOnceItIsSaidAgain) {
  const auto lender = Open({.write = {}, .read = {}, .write_rarely = {Topic::kSegments}});
  const auto reader = Open({.write = {}, .read = {Topic::kSegments}});
  const Message lent = SegmentBatch{AgentId("f"), {test::PieceOf(KeyNumber(1), 0, 100)}};
  EXPECT_EQ(Carry(lent, *lender, *reader, Topic::kSegments), std::vector<Message>{lent});
}

TEST_P(RouteExchangeContract, RefusesATopicNotOpenedForWriting) {
  const auto follower = Open(FollowerTopics());
  const auto result = follower->Publish(Receipt{AgentId("f"), KeyNumber(1), 1});
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ErrorCode::kInvalidArgument);
  EXPECT_THAT(result.error().message, testing::HasSubstr("trailcast/receipts"));
}

TEST_P(RouteExchangeContract, RefusesMessagesOutOfBounds) {
  const auto writer = Open();
  AgentStatus bad_text = Status("a", 1);
  bad_text.detail = "\x1B[2J";
  AgentStatus bad_number = Status("a", 1);
  bad_number.progress = std::numeric_limits<double>::quiet_NaN();
  const std::vector<Message> refused = {
      AgentGone{AgentId("a"), 1},
      Status("not a name", 1),
      bad_text,
      bad_number,
      SegmentBatch{AgentId("a"), {}},
      SegmentBatch{AgentId("a"), {test::PieceOf(KeyNumber(1), 0, kMaxPieceBytes + 1)}},
      SegmentRequest{AgentId("a"), {RouteId("short"), TeachingId(1)}, {}},
      mission::Report{
          .agent = AgentId("a"), .mission = "m", .waits_for = static_cast<mission::WaitsFor>(5)},
      CatalogRequest{AgentId("not a name"), 0, {}}};
  for (const Message& message : refused) {
    const auto result = writer->Publish(message);
    ASSERT_FALSE(result) << message.index();
    EXPECT_EQ(result.error().code, ErrorCode::kInvalidArgument);
  }
}

TEST_P(RouteExchangeContract, TellsWhenAnAgentIsGone) {
  const auto watcher = Open(OperatorTopics());
  auto first = Open();
  auto second = Open();
  ASSERT_TRUE(first->Publish(Status("twin", 1)));
  ASSERT_TRUE(second->Publish(Status("twin", 2)));
  std::vector<Message> got;
  const auto keep = [&](const Message& message) { got.push_back(message); };
  ASSERT_TRUE(TakeUntil(*watcher, keep, [&] { return got.size() >= 2; }));
  EXPECT_THAT(
      got, testing::UnorderedElementsAre(Message(Status("twin", 1)), Message(Status("twin", 2))));
  got.clear();
  first.reset();
  ASSERT_TRUE(TakeUntil(*watcher, keep, [&] { return !got.empty(); }));
  EXPECT_EQ(got, std::vector<Message>({AgentGone{AgentId("twin"), 1}}));
}

TEST_P(RouteExchangeContract, DeliversTheLastWordsOfWhoLeaves) {
  const auto reader = Open();
  auto writer = Open();
  ASSERT_TRUE(Connect(*writer, Topic::kSegments, {reader.get()}));
  const auto sent = test::PiecesOf(KeyNumber(1), 200, 4096);
  ASSERT_TRUE(writer->Publish(SegmentBatch{AgentId("s"), sent}));
  writer.reset();
  std::size_t got = 0;
  EXPECT_TRUE(TakeUntil(
      *reader, [&](const Message& message) { got += test::PiecesIn({message}).size(); },
      [&] { return got == sent.size(); }));
}

INSTANTIATE_TEST_SUITE_P(On, RouteExchangeContract,
                         testing::Values(test::NetworkKind::kInProcess, test::NetworkKind::kDds),
                         [](const auto& param) { return test::NameOf(param.param); });

}  // namespace
}  // namespace trailcast::exchange
