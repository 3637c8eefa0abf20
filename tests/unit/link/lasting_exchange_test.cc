#include "agent/link/lasting_exchange.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "services/exchange/in_process_exchange.h"
#include "services/exchange/topics.h"
#include "tests/support/pieces.h"

namespace trailcast::agent {
namespace {

using exchange::Message;
using std::chrono::milliseconds;
using testing::IsEmpty;
using testing::SizeIs;

class LastingExchangeTest : public testing::Test {
 protected:
  LastingExchangeTest() {
    lasting_.Tend({[this](const Message&) { ++heard_; },
                   [this](exchange::RouteExchange&) { ++said_; },
                   [this](const exchange::AgentStatus& status) { statuses_.push_back(status); }});
  }
  static exchange::AgentStatus Status(const std::string& agent, double progress) {
    exchange::AgentStatus status;
    status.agent = AgentId(agent);
    status.instance = 7;
    status.progress = progress;
    return status;
  }

  // Within half a minute at the most.
  bool Hears(int messages) {
    for (int i = 0; i < 300 && heard_ < messages; ++i) (void)lasting_.Take(milliseconds(100));
    return heard_ >= messages;
  }

  exchange::InProcessBus bus_;
  std::unique_ptr<exchange::RouteExchange> peer_ = bus_.Open(exchange::ServerTopics());
  exchange::TopicUse use_ = [] {
    exchange::TopicUse use = exchange::FollowerTopics();
    use.read.push_back(exchange::Topic::kAgents);
    return use;
  }();
  LastingExchange lasting_{bus_.Open(use_)};
  int heard_ = 0;
  int said_ = 0;
  std::vector<exchange::AgentStatus> statuses_;
};

TEST_F(LastingExchangeTest, AVisitHearsAtFirstWhatALateJoinerWould) {
  ASSERT_TRUE(peer_->Publish(Status("server", 0.1)));
  ASSERT_TRUE(peer_->Publish(Status("server", 0.2)));
  ASSERT_TRUE(peer_->Publish(Status("server2", 0.3)));
  ASSERT_TRUE(peer_->Publish(
      exchange::CatalogReply{.server = AgentId("server"), .client = AgentId("robot1")}));
  ASSERT_TRUE(Hears(3)) << heard_;
  const auto visit = lasting_.Visit();
  const auto at_first = visit->Take(milliseconds(0));
  ASSERT_THAT(at_first, SizeIs(2)) << "of each agent the last, and no replies";
  EXPECT_EQ(std::get<exchange::AgentStatus>(at_first[0]).progress, 0.2);
  EXPECT_THAT(visit->Take(milliseconds(0)), IsEmpty());
  ASSERT_TRUE(peer_->Publish(Status("server", 0.4)));
  EXPECT_THAT(visit->Take(milliseconds(1000)), SizeIs(1)) << "and then what comes";
}

TEST_F(LastingExchangeTest, WhoIsGoneIsNotThere) {
  ASSERT_TRUE(peer_->Publish(Status("server", 0.1)));
  (void)lasting_.Take(milliseconds(1000));
  peer_.reset();
  ASSERT_TRUE(Hears(2)) << heard_;
  EXPECT_THAT(lasting_.Visit()->Take(milliseconds(0)), IsEmpty());
}

TEST_F(LastingExchangeTest, TheAgentItselfGoesOnThroughVisits) {
  const auto visit = lasting_.Visit();
  ASSERT_TRUE(peer_->Publish(Status("server", 0.1)));
  (void)visit->Take(milliseconds(1000));
  EXPECT_EQ(heard_, 1);
  EXPECT_EQ(said_, 1);
  ASSERT_TRUE(visit->Publish(Status("robot1", 0.5)));
  ASSERT_THAT(statuses_, SizeIs(1));
  EXPECT_EQ(statuses_[0].progress, 0.5);
}

TEST_F(LastingExchangeTest, WhatAVisitListenedToEndsWithIt) {
  const route::RouteKey key = test::KeyNumber(1);
  {
    const auto visit = lasting_.Visit();
    ASSERT_TRUE(visit->Listen(exchange::Topic::kSegments, {key}));
    ASSERT_TRUE(peer_->Publish(exchange::SegmentBatch{AgentId("server"), {test::PieceOf(key, 0)}}));
    EXPECT_THAT(visit->Take(milliseconds(1000)), SizeIs(1));
  }
  ASSERT_TRUE(peer_->Publish(exchange::SegmentBatch{AgentId("server"), {test::PieceOf(key, 1)}}));
  EXPECT_THAT(lasting_.Take(milliseconds(0)), IsEmpty());
}

}  // namespace
}  // namespace trailcast::agent
