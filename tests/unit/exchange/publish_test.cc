#include "services/exchange/publish.h"

#include <gtest/gtest.h>

#include <optional>
#include <utility>

#include "tests/support/pieces.h"

namespace trailcast::exchange {
namespace {

// Segments are blocked by a stalled reader, of all routes or of one.
class BlockedExchange : public RouteExchange {
 public:
  explicit BlockedExchange(std::optional<route::RouteKey> route = {}) : route_(std::move(route)) {}

  Result<void> Publish(const Message& message) override {
    ++attempts;
    if (gathers) ++gathered;
    const auto* batch = std::get_if<SegmentBatch>(&message);
    if (batch != nullptr && (!route_ || batch->pieces.front().key == *route_)) {
      return Fail(ErrorCode::kUnavailable, "blocked");
    }
    published.push_back(message);
    return {};
  }
  std::vector<Message> Take(std::chrono::milliseconds) override { return {}; }
  Result<void> Listen(Topic, const std::set<route::RouteKey>&) override { return {}; }
  [[nodiscard]] std::uint64_t dropped() const override { return 0; }

  void Gather() override { gathers = true; }
  void Flush() override { gathers = false; }

  bool gathers = false;
  int gathered = 0;
  int attempts = 0;
  std::vector<Message> published;

 private:
  std::optional<route::RouteKey> route_;
};

SegmentBatch BatchOf(unsigned route) {
  return {AgentId("s"), {test::PieceOf(test::KeyNumber(route), 0)}};
}

TEST(PublishAll, TriesABlockedTopicOnceAndSendsTheRest) {
  const SegmentBatch batch = BatchOf(1);
  const AgentStatus status{.agent = AgentId("s")};
  const CatalogRequest request{.client = AgentId("s")};
  BlockedExchange exchange;
  std::vector<Message> sent;
  std::vector<Message> not_sent;
  const auto result = PublishAll(
      exchange, std::vector<Message>{batch, status, batch, batch, request},
      [&](const Message& message, bool done) { (done ? sent : not_sent).push_back(message); });
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().message, "blocked");
  EXPECT_EQ(exchange.attempts, 3);
  EXPECT_EQ(exchange.published, (std::vector<Message>{status, request}));
  EXPECT_EQ(sent, exchange.published);
  EXPECT_EQ(not_sent, (std::vector<Message>{batch, batch, batch}));
}

TEST(PublishAll, HasSeveralMessagesTravelTogether) {
  BlockedExchange exchange;
  const AgentStatus status{.agent = AgentId("s")};
  ASSERT_TRUE(PublishAll(exchange, std::vector<Message>{status, status}));
  EXPECT_EQ(exchange.gathered, 2);
  EXPECT_FALSE(exchange.gathers) << "held back";
}

TEST(PublishAll, ABlockedRouteDoesNotHoldUpTheOthers) {
  BlockedExchange exchange(test::KeyNumber(1));
  ASSERT_FALSE(PublishAll(exchange, std::vector<Message>{BatchOf(1), BatchOf(1), BatchOf(2)}));
  EXPECT_EQ(exchange.published, (std::vector<Message>{BatchOf(2)}));
  EXPECT_EQ(exchange.attempts, 2);
}

TEST(PublishAll, AFewBlockedRoutesAreTriedAndNoMore) {
  BlockedExchange exchange;
  std::vector<Message> messages;
  for (unsigned route = 1; route <= 20; ++route) messages.emplace_back(BatchOf(route));
  ASSERT_FALSE(PublishAll(exchange, messages));
  EXPECT_EQ(exchange.attempts, kMostBlocked);
}

TEST(PublishAll, WhatCanNeverBeSentIsNotToldAsBlocked) {
  class Refusing : public BlockedExchange {
   public:
    Result<void> Publish(const Message&) override {
      return Fail(ErrorCode::kInvalidArgument, "out of bounds");
    }
  };
  Refusing exchange;
  int told = 0;
  ASSERT_FALSE(PublishAll(exchange, std::vector<Message>{BatchOf(1)},
                          [&](const Message&, bool) { ++told; }));
  EXPECT_EQ(told, 0);
}

TEST(PublishAll, OfNothingSucceeds) {
  BlockedExchange exchange;
  EXPECT_TRUE(PublishAll(exchange, {}));
}

}  // namespace
}  // namespace trailcast::exchange
