#include "services/exchange/publish.h"

#include <gtest/gtest.h>

#include "tests/support/pieces.h"

namespace trailcast::exchange {
namespace {

// Its segments are blocked by a stalled reader.
class BlockedExchange : public RouteExchange {
 public:
  Result<void> Publish(const Message& message) override {
    ++attempts;
    if (std::holds_alternative<SegmentBatch>(message)) {
      return Fail(ErrorCode::kUnavailable, "blocked");
    }
    published.push_back(message);
    return {};
  }
  std::vector<Message> Take(std::chrono::milliseconds) override { return {}; }
  [[nodiscard]] std::uint64_t dropped() const override { return 0; }

  int attempts = 0;
  std::vector<Message> published;
};

TEST(PublishAll, TriesABlockedTopicOnceAndSendsTheRest) {
  const SegmentBatch batch{AgentId("s"), {test::PieceOf(test::KeyNumber(1), 0)}};
  const AgentStatus status{.agent = AgentId("s")};
  const CatalogRequest request{.client = AgentId("s")};
  BlockedExchange exchange;
  std::vector<Message> told;
  const auto result =
      PublishAll(exchange, std::vector<Message>{batch, status, batch, batch, request},
                 [&](const Message& message) { told.push_back(message); });
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().message, "blocked");
  EXPECT_EQ(exchange.attempts, 3);
  EXPECT_EQ(exchange.published, (std::vector<Message>{status, request}));
  EXPECT_EQ(told, exchange.published);
}

TEST(PublishAll, OfNothingSucceeds) {
  BlockedExchange exchange;
  EXPECT_TRUE(PublishAll(exchange, {}));
}

}  // namespace
}  // namespace trailcast::exchange
