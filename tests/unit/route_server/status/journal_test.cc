#include "route_server/status/journal.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace trailcast::server {
namespace {

using exchange::Receipt;
using exchange::RouteAnnouncement;
using testing::AllOf;
using testing::HasSubstr;
using testing::Optional;

const route::RouteKey kKey{RouteId(std::string(32, '1')), TeachingId(1)};

RouteAnnouncement Announcement() {
  RouteAnnouncement announcement;
  announcement.holder = AgentId("scout");
  announcement.info.key = kKey;
  announcement.info.name = "hall";
  announcement.info.revision = RevisionNumber(1);
  announcement.info.scout = AgentId("scout");
  announcement.info.camera = "webcam 320x240";
  return announcement;
}

Receipt ReceiptOf(std::uint32_t prefix) { return {AgentId("server"), kKey, prefix, {}, {}}; }

TEST(JournalTest, TellsWhoTeachesWhatOnce) {
  Journal journal;
  EXPECT_THAT(journal.Received(Announcement()),
              Optional(AllOf(HasSubstr("scout 'scout' teaches"), HasSubstr("'hall' revision 1"))));
  EXPECT_EQ(journal.Received(Announcement()), std::nullopt);
}

TEST(JournalTest, TellsWhoToldRobotsWhatOnce) {
  Journal journal;
  const exchange::NowCommand stop{
      .client = AgentId("desk-p7"), .number = 1, .order = exchange::NowOrder::kStop};
  EXPECT_EQ(journal.Received(stop), "'desk-p7' tells all robots to stop");
  EXPECT_EQ(journal.Received(stop), std::nullopt);
  const exchange::NowAnswer answer{.agent = AgentId("robot1"),
                                   .client = AgentId("desk-p7"),
                                   .number = 1,
                                   .detail = "stopped by desk"};
  EXPECT_EQ(journal.Received(answer), "'robot1' obeys 'desk-p7': stopped by desk");
  EXPECT_EQ(journal.Received(answer), std::nullopt);
  // Another process of the same name, in another container.
  const exchange::NowCommand release{
      .client = AgentId("desk-p7"), .number = 1 << 20, .order = exchange::NowOrder::kRelease};
  EXPECT_EQ(journal.Received(release), "'desk-p7' tells all robots to release");
  EXPECT_EQ(journal.Received(stop), std::nullopt);
}

TEST(JournalTest, TellsOfReceiptsWhenTheyHaveDoubledAndAtTheEnd) {
  Journal journal;
  ASSERT_TRUE(journal.Received(Announcement()));
  EXPECT_EQ(journal.Sent(ReceiptOf(0)), std::nullopt);
  EXPECT_THAT(journal.Sent(ReceiptOf(2)), Optional(HasSubstr("'hall' revision 1: 2 segments")));
  EXPECT_EQ(journal.Sent(ReceiptOf(2)), std::nullopt);
  EXPECT_EQ(journal.Sent(ReceiptOf(3)), std::nullopt);
  EXPECT_THAT(journal.Sent(ReceiptOf(4)),
              Optional(HasSubstr("4 segments stored and acknowledged")));
  Receipt last = ReceiptOf(5);
  last.durable_state = route::RouteState::kComplete;
  EXPECT_THAT(journal.Sent(last),
              Optional(HasSubstr("5 segments stored and acknowledged, complete")));
  EXPECT_EQ(journal.Sent(last), std::nullopt);
}

TEST(JournalTest, ForgetsRoutesRatherThanGrow) {
  Journal journal;
  ASSERT_TRUE(journal.Received(Announcement()));
  RouteAnnouncement other = Announcement();
  for (unsigned i = 0; i < 20'000; ++i) {
    other.info.key.route = RouteId(fmt::format("{:032x}", i));
    EXPECT_TRUE(journal.Received(other));
  }
  EXPECT_TRUE(journal.Received(Announcement())) << "new again";
}

TEST(JournalTest, TellsWhenAgentsComeReturnAndGo) {
  Journal journal;
  exchange::AgentStatus status;
  status.agent = AgentId("robot2");
  status.instance = 5;
  status.role = exchange::AgentRole::kFollower;
  EXPECT_EQ(journal.Received(status), "follower 'robot2' is there");
  EXPECT_EQ(journal.Received(status), std::nullopt);
  status.instance = 6;
  EXPECT_EQ(journal.Received(status), "follower 'robot2' is there again");
  EXPECT_EQ(journal.Received(exchange::AgentGone{AgentId("robot2"), 5}), std::nullopt)
      << "the earlier process";
  EXPECT_EQ(journal.Received(exchange::AgentGone{AgentId("robot2"), 6}), "'robot2' is gone");
}

TEST(JournalTest, TellsWhatFollowersAskFor) {
  Journal journal;
  ASSERT_TRUE(journal.Received(Announcement()));
  const exchange::SegmentRequest request{
      AgentId("robot2"), kKey, {SegmentIndex(4), SegmentIndex(5)}};
  EXPECT_EQ(journal.Received(request),
            "'robot2' asks for 2 segments of 'hall' revision 1, from 4 on");
}

TEST(JournalTest, ForgetsAgentsRatherThanGrow) {
  Journal journal;
  exchange::AgentStatus status;
  for (std::size_t i = 0; i < 2 * Journal::kMostAgents; ++i) {
    status.agent = AgentId(fmt::format("made-up-{}", i));
    EXPECT_TRUE(journal.Received(status));
  }
  EXPECT_EQ(journal.agents(), Journal::kMostAgents);
  EXPECT_EQ(journal.Received(status), std::nullopt) << "the newest are known";
}

}  // namespace
}  // namespace trailcast::server
