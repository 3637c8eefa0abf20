#pragma once

#include <fuzzer/FuzzedDataProvider.h>

#include <chrono>
#include <string>
#include <vector>

#include "services/exchange/bounds.h"
#include "services/exchange/messages.h"
#include "tests/fuzz/fuzz.h"
#include "tests/support/pieces.h"

namespace trailcast::fuzz {

using Time = std::chrono::steady_clock::time_point;

// These are messages that strangers may send to a robot or a server: within bounds, and otherwise
// anything. They are about few routes and few segments, so that they often contradict each other.
class Stranger {
 public:
  explicit Stranger(FuzzedDataProvider& input) : input_(input) {}

  exchange::Message Say() {
    exchange::Message message = SayAnything();
    Require(exchange::CheckBounds(message).has_value(), "what is said is within bounds");
    return message;
  }

  route::RouteInfo Info() {
    const std::vector<route::SegmentPiece> pieces =
        test::PiecesOf(Key(), input_.ConsumeIntegralInRange<std::uint32_t>(0, 6), kPieceBytes);
    const auto key = pieces.empty() ? Key() : pieces.front().key;
    route::RouteInfo info = test::InfoOf(key, pieces, State());
    if (Seldom()) info.name = "other";
    if (Seldom()) info.manifest_digest.fill(input_.ConsumeIntegral<std::uint8_t>());
    if (Seldom())
      info.segment_count = input_.ConsumeIntegralInRange<std::uint32_t>(0, kMostSegments);
    if (Seldom())
      info.bytes = input_.ConsumeIntegralInRange<std::uint64_t>(0, route::kMaxRouteBytes);
    if (Seldom()) info.length_m = 1e7;
    if (Seldom()) info.scout = Name();
    if (Seldom()) info.taught_unix_ms = input_.ConsumeIntegral<std::int64_t>();
    if (Seldom()) info.tags = {"a", "b"};
    if (Seldom()) info.to_review = true;
    if (Seldom()) info.description = "past the greenhouse";
    if (Seldom()) info.refreshes = RevisionNumber(input_.ConsumeIntegral<std::uint32_t>());
    if (Seldom()) info.edition = input_.ConsumeIntegralInRange<std::uint32_t>(0, 3);
    if (Seldom())
      info.standing = static_cast<route::Standing>(input_.ConsumeIntegralInRange<int>(0, 3));
    if (Seldom()) info.place = {route::Place::Frame::kWgs84, -180.0, 90.0};
    return info;
  }
  route::RouteKey Key() {
    return test::KeyNumber(input_.ConsumeIntegralInRange<unsigned>(0, 5), Seldom() ? 2 : 1);
  }
  // It is rarely far, because every wanted segment costs time.
  SegmentIndex Index() {
    const std::uint32_t most = Seldom() ? route::kMaxSegmentsPerRoute - 1 : 7;
    return SegmentIndex(input_.ConsumeIntegralInRange<std::uint32_t>(0, most));
  }
  std::vector<SegmentIndex> Indices() {
    std::vector<SegmentIndex> indices(input_.ConsumeIntegralInRange<std::size_t>(0, 8));
    for (SegmentIndex& index : indices) index = Index();
    return indices;
  }
  std::chrono::milliseconds Pause() {
    return std::chrono::milliseconds(input_.ConsumeIntegralInRange<int>(0, 12'000));
  }

 private:
  static constexpr std::size_t kPieceBytes = 20;
  static constexpr std::uint32_t kMostSegments = 300;

  exchange::Message SayAnything() {
    switch (input_.ConsumeIntegralInRange<int>(0, 8)) {
      case 0:
        return exchange::RouteAnnouncement{.holder = Name(), .info = Info()};
      case 1:
        return exchange::SegmentBatch{.sender = Name(), .pieces = Pieces()};
      case 2:
        return exchange::SegmentRequest{
            .requester = Name(), .key = Key(), .lacking = Indices(), .digests_only = Seldom()};
      case 3:
        return Receipt();
      case 4:
        return exchange::CatalogRequest{.client = Name(),
                                        .request = 1,
                                        .query = {.name = input_.ConsumeRandomLengthString(70)}};
      case 5:
        return exchange::CatalogReply{
            .server = Name(), .client = Name(), .page = {{Info()}, 1, ""}};
      case 6:
        return exchange::AgentStatus{.agent = Name()};
      case 7:
        return exchange::RouteEditRequest{
            .client = Name(), .request = input_.ConsumeIntegral<std::uint8_t>(), .edit = Edit()};
      default:
        return exchange::AgentGone{.agent = Name()};
    }
  }
  std::vector<route::SegmentPiece> Pieces() {
    std::vector<route::SegmentPiece> pieces;
    const auto count = input_.ConsumeIntegralInRange<std::size_t>(1, 6);
    const route::RouteKey key = Key();
    while (pieces.size() < count) {
      pieces.push_back(
          test::PieceOf(Seldom() ? Key() : key, Index().value(), kPieceBytes, Seldom() ? 1 : 0));
      if (Seldom()) pieces.back().bytes[0] ^= 1U;
    }
    return pieces;
  }
  // It is mostly about the pieces that Pieces makes.
  exchange::Receipt Receipt() {
    const route::RouteKey key = Key();
    const auto count = input_.ConsumeIntegralInRange<std::uint32_t>(0, 20);
    exchange::Receipt receipt = test::ReceiptFor(
        Name(), key, test::PiecesOf(key, count, kPieceBytes), count, Indices(), State());
    if (Seldom()) receipt.prefix_digest[0] ^= 1U;
    receipt.durable_prefix = Seldom() ? Index().value() : count;
    receipt.revision = RevisionNumber(input_.ConsumeIntegralInRange<std::uint32_t>(0, 3));
    receipt.refusal = Refusal();
    receipt.reason = "so it is";
    return receipt;
  }
  route::RouteEdit Edit() {
    route::RouteEdit edit{
        .action = static_cast<route::EditAction>(input_.ConsumeIntegralInRange<int>(0, 8)),
        .route = Seldom()               ? "other"
                 : input_.ConsumeBool() ? "corridor"
                                        : Key().route.value(),
        .revision = input_.ConsumeIntegralInRange<std::uint32_t>(0, 2),
        .text = input_.ConsumeRandomLengthString(20)};
    if (input_.ConsumeBool()) edit.tags = {"wet"};
    return edit;
  }
  exchange::Refusal Refusal() {
    return static_cast<exchange::Refusal>(Seldom() ? input_.ConsumeIntegralInRange<int>(1, 2) : 0);
  }
  AgentId Name() {
    return AgentId(input_.PickValueInArray({"scout-1", "follower-1", "server", "stranger"}));
  }
  route::RouteState State() {
    return input_.ConsumeBool() ? route::RouteState::kComplete : route::RouteState::kTeaching;
  }
  bool Seldom() { return input_.ConsumeIntegral<std::uint8_t>() > 240; }

  FuzzedDataProvider& input_;
};

// Requires that all messages that are sent could be published.
inline void RequireBounds(const std::vector<exchange::Message>& messages) {
  for (const exchange::Message& message : messages) {
    Require(exchange::CheckBounds(message).has_value(), "what is sent is within bounds");
  }
}

}  // namespace trailcast::fuzz
