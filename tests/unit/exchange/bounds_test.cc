#include "services/exchange/bounds.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "tests/support/pieces.h"

namespace trailcast::exchange {
namespace {

using test::KeyNumber;

RouteAnnouncement Good() {
  return {AgentId("server-1"), test::InfoOf(KeyNumber(1), {}, route::RouteState::kTeaching)};
}

void ExpectRefused(const Message& message, const std::string& naming) {
  const auto result = CheckBounds(message);
  ASSERT_FALSE(result) << "accepted, expected a refusal naming " << naming;
  EXPECT_EQ(result.error().code, ErrorCode::kInvalidArgument);
  EXPECT_THAT(result.error().message, testing::HasSubstr(naming));
}

TEST(CheckBounds, AcceptsAnOrdinaryAnnouncement) { EXPECT_TRUE(CheckBounds(Good())); }

TEST(CheckBounds, RefusesEachBadFieldOfAnAnnouncementByName) {
  const auto with = [](const auto& spoil) {
    RouteAnnouncement message = Good();
    spoil(message.info);
    return message;
  };
  using Info = route::RouteInfo;
  ExpectRefused(with([](Info& i) { i.name = std::string("../etc"); }), "route name");
  ExpectRefused(with([](Info& i) { i.scout = AgentId(""); }), "scout");
  ExpectRefused(with([](Info& i) { i.camera = std::string("\xFF"); }), "camera");
  ExpectRefused(with([](Info& i) { i.image_width_px = -1; }), "image width");
  ExpectRefused(with([](Info& i) { i.image_height_px = 65536; }), "image height");
  ExpectRefused(with([](Info& i) { i.state = static_cast<route::RouteState>(2); }), "state");
  ExpectRefused(with([](Info& i) { i.segment_count = ~0U; }), "segment count");
  ExpectRefused(with([](Info& i) { i.bytes = 1ULL << 63U; }), "bytes in a route");
  ExpectRefused(with([](Info& i) { i.length_m = -0.5; }), "length");
  ExpectRefused(with([](Info& i) { i.length_m = std::numeric_limits<double>::infinity(); }),
                "length");
  ExpectRefused(with([](Info& i) { i.key.route = RouteId(std::string(32, 'G')); }), "route id");
  ExpectRefused(with([](Info& i) { i.key.teaching = TeachingId(0); }), "teaching");
}

TEST(CheckBounds, RefusesPlacesThatNoRouteHas) {
  CatalogReply good{AgentId("s"), AgentId("f"), 1, {}, {}, {}};
  good.places = {{KeyNumber(1), SegmentIndex(0), 0.5}};
  EXPECT_TRUE(CheckBounds(good));
  const auto with = [&](const route::FoundPlace& place) {
    CatalogReply message = good;
    message.places = {place};
    return message;
  };
  ExpectRefused(with({{RouteId("x"), TeachingId(1)}, SegmentIndex(0), 0.5}), "route id");
  ExpectRefused(with({KeyNumber(1), SegmentIndex(route::kMaxSegmentsPerRoute), 0.5}),
                "segment index");
  ExpectRefused(with({KeyNumber(1), SegmentIndex(0), 1.5}), "score");
  CatalogReply many = good;
  many.places.resize(kMaxPlacesPerReply + 1, good.places[0]);
  ExpectRefused(many, "places in a reply");
}

TEST(CheckBounds, RefusesPiecesWithoutDigest) {
  route::SegmentPiece no_digest = test::PieceOf(KeyNumber(1), 0);
  no_digest.digest = {};
  route::SegmentPiece no_bytes = test::PieceOf(KeyNumber(1), 0);
  no_bytes.bytes.clear();
  ExpectRefused(SegmentBatch{AgentId("s"), {no_digest}}, "no digest");
  EXPECT_TRUE(CheckBounds(SegmentBatch{AgentId("s"), {no_bytes}})) << "a digest alone";
  ExpectRefused(
      SegmentBatch{AgentId("s"), {test::PieceOf(KeyNumber(1), route::kMaxSegmentsPerRoute)}},
      "index");
}

TEST(CheckBounds, RefusesListsThatAreTooLong) {
  ExpectRefused(
      SegmentRequest{AgentId("f"), KeyNumber(1), test::Indices(0, kMaxIndicesPerRequest + 1)},
      "lacking");
  Receipt receipt{.server = AgentId("s"), .key = KeyNumber(1)};
  receipt.durable_beyond.resize(kMaxSegmentsPerReceipt + 1);
  ExpectRefused(receipt, "durable");
}

TEST(CheckBounds, RefusesEnumeratorsThatDoNotExist) {
  AgentStatus status{.agent = AgentId("a")};
  status.mode = static_cast<AgentMode>(7);
  ExpectRefused(status, "mode");
  status.mode = AgentMode::kFault;
  status.role = static_cast<AgentRole>(4);
  ExpectRefused(status, "role");
  mission::Report report{.agent = AgentId("a"), .mission = "m", .state = mission::State::kPutOff};
  EXPECT_TRUE(CheckBounds(report)) << "a server's word";
  report.change = 1;
  ExpectRefused(report, "mission state");
}

TEST(CheckBounds, RefusesPlacesThatAreNowhereOnARoute) {
  AgentStatus status{.agent = AgentId("a")};
  status.place = PlaceOnRoute{KeyNumber(1), 12.5};
  EXPECT_TRUE(CheckBounds(status));
  status.place->along_m = -0.1;
  ExpectRefused(status, "metres along the route");
  status.place = PlaceOnRoute{{}, 12.5};
  ExpectRefused(status, "route id");
}

TEST(CheckBounds, RefusesOdometryThatNobodyCouldTrustSo) {
  AgentStatus status{.agent = AgentId("a")};
  status.following = Following{CarriedBy::kMotion, OdometryTrust{100, 0.0}};
  EXPECT_TRUE(CheckBounds(status));
  status.following->odometry->percent = 101;
  ExpectRefused(status, "trust in odometry");
  status.following->odometry = OdometryTrust{100, -1.0};
  ExpectRefused(status, "scale of odometry");
  status.following->odometry->scale = std::numeric_limits<double>::quiet_NaN();
  ExpectRefused(status, "scale of odometry");
  status.following = Following{static_cast<CarriedBy>(4), std::nullopt};
  ExpectRefused(status, "carried by");
}

TEST(CheckBounds, RefusesWhatNobodyHears) {
  const ReachReport good{.agent = AgentId("r"),
                         .client = AgentId("o"),
                         .heard = {{.agent = AgentId("s"), .late_ms = -1.0}}};
  EXPECT_TRUE(CheckBounds(good));
  const auto with = [&](const auto& spoil) {
    ReachReport message = good;
    spoil(message.heard.front());
    return message;
  };
  static constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();
  ExpectRefused(with([](HeardAgent& h) { h.agent = AgentId(""); }), "heard agent");
  ExpectRefused(with([](HeardAgent& h) { h.role = static_cast<AgentRole>(9); }), "role");
  ExpectRefused(with([](HeardAgent& h) { h.late_ms = kNotANumber; }), "under way");
  ExpectRefused(with([](HeardAgent& h) { h.round_trip_ms = kNotANumber; }), "there and back");
  ExpectRefused(with([](HeardAgent& h) { h.address.assign(kMaxAddressBytes + 1, '1'); }),
                "address");
  ExpectRefused(with([](HeardAgent& h) { h.network = "a\nb"; }), "network interface");
  ReachReport many = good;
  many.heard.resize(kMaxHeardAgents + 1, good.heard.front());
  ExpectRefused(many, "agents heard");
  ExpectRefused(ReachRequest{.client = AgentId("o"), .relayed = true}, "server");
}

TEST(CheckBounds, APhotoComesInBoundedPieces) {
  const PhotoPiece good{.holder = AgentId("r"), .client = AgentId("s"), .photo = "4f2a"};
  EXPECT_TRUE(CheckBounds(good));
  PhotoPiece message = good;
  message.bytes.resize(kMaxPhotoPieceBytes + 1);
  ExpectRefused(message, "bytes of a photo");
  message = good;
  message.offset = kMaxPhotoBytes + 1;
  ExpectRefused(message, "place in a photo");
  message = good;
  message.photo = "../4f2a";
  ExpectRefused(message, "photo");
  message = good;
  message.words.assign(kMaxLineBytes + 1, 'w');
  ExpectRefused(message, "words");
  const PhotoRequest asks{.client = AgentId("s"), .holder = AgentId("r"), .photo = "4f2a"};
  EXPECT_TRUE(CheckBounds(asks));
  PhotoRequest request = asks;
  request.photo = "";
  ExpectRefused(request, "photo");
  request = asks;
  request.refusal = "a\nb";
  ExpectRefused(request, "refusal");
}

TEST(CheckBounds, ASummaryOfAStoreTellsPartsOrRevisionsBelowAWholeNumberOfDigitPairs) {
  const StoreSummary good{.server = AgentId("s"), .prefix = "a3"};
  EXPECT_TRUE(CheckBounds(good));
  for (const std::string prefix : {"a", "A3", "xy", "a3f"}) {
    StoreSummary message = good;
    message.prefix = prefix;
    ExpectRefused(message, "route ids");
  }
  StoreSummary parts = good;
  parts.parts.resize(256);
  EXPECT_TRUE(CheckBounds(parts));
  parts.entries.push_back({KeyNumber(1), 1});
  ExpectRefused(parts, "either 256 parts");
  parts.entries.clear();
  parts.parts.resize(255);
  ExpectRefused(parts, "255 parts");
  StoreSummary many = good;
  many.entries.resize(kMaxEntriesTold + 1, {KeyNumber(1), 1});
  ExpectRefused(many, "4097");
  many.entries = {{route::RouteKey{}, 1}};
  ExpectRefused(many, "route id");
}

}  // namespace
}  // namespace trailcast::exchange
