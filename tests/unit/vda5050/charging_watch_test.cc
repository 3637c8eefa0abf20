#include "services/vda5050/charging_watch.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace trailcast::vda5050 {
namespace {

using std::chrono::milliseconds;

class ChargingWatchTest : public testing::Test {
 protected:
  // Asks, and has a server answer so.
  void Answer(const char* server, std::vector<std::string> lines, std::string error = "") {
    now_ += ChargingWatch::kAskEvery;
    const auto asked = watch_.Due(now_);
    ASSERT_TRUE(asked);
    EXPECT_EQ(asked->words, "charging");
    Reply({.server = AgentId(server),
           .client = asked->client,
           .request = asked->request,
           .lines = std::move(lines),
           .error = std::move(error)});
  }
  void Reply(exchange::NetworkReply reply) {
    last_ = std::move(reply);
    watch_.Hear(last_, now_);
  }
  std::string Words() { return watch_.WordsOf("robot1", now_); }

  ChargingWatch watch_{AgentId("vda5050-1")};
  ChargingWatch::Time now_{std::chrono::hours(1)};
  exchange::NetworkReply last_;
};

TEST_F(ChargingWatchTest, ARobotChargesWhereAServerSaysSo) {
  EXPECT_EQ(Words(), "");
  Answer("server", {"charging robot1 goes to dock1 to charge", "charging robot2 charges at dock2"});
  EXPECT_EQ(Words(), "") << "it does not yet";
  Answer("server", {"charging robot1 charges at dock1: its battery is at 17 %"});
  EXPECT_EQ(Words(), "charges at dock1: its battery is at 17 %");
  Answer("mirror", {});
  EXPECT_NE(Words(), "") << "another server does not know of it";
  Answer("server", {});
  EXPECT_EQ(Words(), "");
}

TEST_F(ChargingWatchTest, NothingIsMadeUpWhereNobodyAnswersItsQuestion) {
  Answer("server", {"charging robot1 charges at dock1"});
  EXPECT_FALSE(watch_.Due(now_ + milliseconds(10)));
  now_ += ChargingWatch::kCountsFor;
  EXPECT_NE(Words(), "");
  now_ += milliseconds(1);
  EXPECT_EQ(Words(), "") << "the server is silent";
  exchange::NetworkReply others = last_;
  others.client = AgentId("desk");
  Reply(others);
  EXPECT_EQ(Words(), "");
  Answer("server", {"charging robot1 charges at dock1"}, "'charging': 'way FROM TO' is expected");
  EXPECT_EQ(Words(), "") << "a server from before it knew that question";
}

}  // namespace
}  // namespace trailcast::vda5050
