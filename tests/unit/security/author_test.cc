#include "services/security/author.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "services/base/process_name.h"

namespace trailcast::security {
namespace {

using exchange::AgentRole;
using exchange::AgentStatus;
using testing::HasSubstr;

class AuthorTest : public testing::Test {
 protected:
  Member Is(Role role, const std::string& name) const { return {role, MemberIdOf(key_, name), 1}; }
  // Why the message is not taken; empty when it is.
  std::string Fault(const exchange::Message& message, const Member& sender) const {
    const auto own = CheckAuthor(message, sender, key_);
    return own ? "" : own.error().message;
  }
  static exchange::RouteAnnouncement Announcement(const std::string& holder,
                                                  const std::string& scout) {
    exchange::RouteAnnouncement announcement{.holder = AgentId(holder)};
    announcement.info.scout = AgentId(scout);
    return announcement;
  }

  const std::string key_ = "name key";
};

TEST_F(AuthorTest, NobodySpeaksInTheNameOfAnother) {
  const exchange::SegmentRequest request{.requester = AgentId("robot1")};
  EXPECT_EQ(Fault(request, Is(Role::kFollower, "robot1")), "");
  EXPECT_THAT(Fault(request, Is(Role::kFollower, "robot2")), HasSubstr("in the name of 'robot1'"));
  EXPECT_NE(Fault(exchange::AgentGone{.agent = AgentId("robot1")}, Is(Role::kScout, "robot2")), "");
}

TEST_F(AuthorTest, AMembersCommandsHaveTheirProcessBehindItsName) {
  const exchange::RouteEditRequest edit{.client = AgentId(ProcessName("desk", 4711))};
  EXPECT_EQ(Fault(edit, Is(Role::kOperator, "desk")), "");
  EXPECT_NE(Fault(edit, Is(Role::kOperator, "lab")), "");
  const exchange::CatalogRequest request{.client = AgentId("robot-1")};
  EXPECT_NE(Fault(request, Is(Role::kFollower, "robot")), "");
  EXPECT_EQ(Fault(request, Is(Role::kFollower, "robot-1")), "");
}

TEST_F(AuthorTest, OnlyServersPassOnWhatOperatorsTellRobots) {
  exchange::NowCommand command{.client = AgentId(ProcessName("desk", 4711))};
  EXPECT_EQ(Fault(command, Is(Role::kOperator, "desk")), "");
  EXPECT_NE(Fault(command, Is(Role::kServer, "server")), "") << "in the operator's name";
  command.relayed = true;
  EXPECT_EQ(Fault(command, Is(Role::kServer, "server")), "");
  EXPECT_THAT(Fault(command, Is(Role::kOperator, "desk")), HasSubstr("which only servers do"));
  exchange::NowAnswer answer{.agent = AgentId("robot1")};
  EXPECT_EQ(Fault(answer, Is(Role::kFollower, "robot1")), "");
  EXPECT_NE(Fault(answer, Is(Role::kFollower, "robot2")), "");
  answer.relayed = true;
  EXPECT_NE(Fault(answer, Is(Role::kFollower, "robot1")), "");
}

TEST_F(AuthorTest, AStatusTellsTheSendersRole) {
  const AgentStatus server{.agent = AgentId("x"), .role = AgentRole::kServer};
  EXPECT_EQ(Fault(server, Is(Role::kServer, "x")), "");
  EXPECT_THAT(Fault(server, Is(Role::kFollower, "x")), HasSubstr("another role"));
  const AgentStatus follower{.agent = AgentId("x"), .role = AgentRole::kFollower};
  EXPECT_EQ(Fault(follower, Is(Role::kScout, "x")), "");
}

TEST_F(AuthorTest, AScoutAnnouncesWhatItTaughtAndNoLabels) {
  exchange::RouteAnnouncement own = Announcement("robot1", "robot1");
  const Member scout = Is(Role::kScout, "robot1");
  EXPECT_EQ(Fault(own, scout), "");
  EXPECT_THAT(Fault(Announcement("robot1", "robot2"), scout), HasSubstr("that 'robot2' taught"));
  own.info.edition = 7;
  own.info.standing = route::Standing::kDeleted;
  EXPECT_THAT(Fault(own, scout), HasSubstr("only operators"));
  EXPECT_EQ(Fault(own, Is(Role::kServer, "robot1")), "");
}

}  // namespace
}  // namespace trailcast::security
