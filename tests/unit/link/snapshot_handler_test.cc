#include "agent/link/snapshot_handler.h"

#include <gtest/gtest.h>

#include "services/exchange/bounds.h"

namespace trailcast::agent {
namespace {

using std::chrono::milliseconds;

// These are about robot1, at a time that passes when the test says so.
class SnapshotHandlerTest : public testing::Test {
 protected:
  void Ask(const std::string& client, std::uint64_t request, const std::string& robot = "robot1") {
    handler_.Handle(
        exchange::SnapshotRequest{
            .agent = AgentId(robot), .client = AgentId(client), .request = request},
        now_);
  }
  // Returns who gets a picture that is made now, or an empty text for nobody.
  std::string Served() {
    if (!handler_.Asks(now_)) return "";
    const auto given = handler_.Give({.jpeg = {1, 2, 3}}, now_);
    EXPECT_TRUE(given);
    EXPECT_EQ(given->agent, AgentId("robot1"));
    EXPECT_EQ(given->picture.size(), 3U);
    return given->client.value() + std::to_string(given->request);
  }

  SnapshotHandler::Time now_{};
  SnapshotHandler handler_{AgentId("robot1")};
};

TEST_F(SnapshotHandlerTest, MakesOnePictureForEachRequestAndNoneOtherwise) {
  EXPECT_EQ(Served(), "");
  Ask("desk", 7);
  EXPECT_EQ(Served(), "desk7");
  now_ += milliseconds(5000);
  EXPECT_EQ(Served(), "") << "nobody looks any more";
  Ask("desk", 8, "robot2");
  EXPECT_EQ(Served(), "") << "another robot is meant";
}

TEST_F(SnapshotHandlerTest, GivesFiveASecondInAllHoweverManyAskHoweverOften) {
  int given = 0;
  for (int ms = 0; ms < 10'000; ms += 10) {
    now_ += milliseconds(10);
    for (int client = 0; client < 20; ++client) {
      Ask("desk" + std::to_string(client), static_cast<std::uint64_t>(ms));
    }
    if (!Served().empty()) ++given;
  }
  EXPECT_EQ(given, 50);
}

TEST_F(SnapshotHandlerTest, ServesWhoHasWaitedLongestWithTheNewestRequest) {
  Ask("a", 1);
  Ask("b", 1);
  Ask("a", 2);
  EXPECT_EQ(Served(), "a2");
  Ask("a", 3);
  now_ += SnapshotHandler::kEvery;
  EXPECT_EQ(Served(), "b1");
  now_ += SnapshotHandler::kEvery;
  EXPECT_EQ(Served(), "a3");
}

TEST_F(SnapshotHandlerTest, MoreThanEightThatWaitAreNotHeard) {
  std::string waiting = "abcdefgh";
  std::string served;
  while (served.size() < 8) {
    // A client that waits asks repeatedly, and keeps its place; the ninth is one too many.
    for (const char client : waiting) Ask(std::string(1, client), 1);
    if (served.empty()) Ask("i", 1);
    const std::string client = Served();
    ASSERT_FALSE(client.empty());
    served += client[0];
    std::erase(waiting, client[0]);
    now_ += SnapshotHandler::kEvery;
  }
  EXPECT_EQ(served, "abcdefgh");
  EXPECT_EQ(Served(), "");
}

TEST_F(SnapshotHandlerTest, SaysWhyBeforeWhoAsksGivesUp) {
  Ask("desk", 7);
  ASSERT_TRUE(handler_.Asks(now_));
  EXPECT_FALSE(handler_.Asks(now_)) << "one at a time";
  now_ += SnapshotHandler::kPatience;
  EXPECT_FALSE(handler_.AskedInVain(now_));
  now_ += milliseconds(1);
  ASSERT_TRUE(handler_.AskedInVain(now_));
  const auto given = handler_.Give({.detail = "the camera\nis dead"}, now_);
  ASSERT_TRUE(given);
  EXPECT_TRUE(given->picture.empty());
  EXPECT_EQ(given->detail, "the camera is dead");
  EXPECT_FALSE(handler_.AskedInVain(now_));
  EXPECT_FALSE(handler_.Give({.jpeg = {1}}, now_)) << "it comes too late";
}

TEST_F(SnapshotHandlerTest, WhoGaveUpMeanwhileGetsNothing) {
  Ask("desk", 7);
  ASSERT_TRUE(handler_.Asks(now_));
  now_ += SnapshotHandler::kAskedFor + milliseconds(1);
  EXPECT_FALSE(handler_.Give({.jpeg = {1}}, now_));
  Ask("desk", 8);
  EXPECT_EQ(Served(), "desk8");
}

}  // namespace
}  // namespace trailcast::agent
