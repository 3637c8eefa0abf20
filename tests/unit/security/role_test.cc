#include "services/security/role.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "services/base/process_name.h"
#include "services/exchange/topics.h"
#include "services/security/member.h"

namespace trailcast::security {
namespace {

using exchange::Topic;
using testing::Contains;
using testing::ElementsAre;
using testing::Not;

TEST(Role, HasANameByWhichItIsFound) {
  for (const Role role : AllRoles()) EXPECT_EQ(FindRole(NameOf(role)), role);
  EXPECT_EQ(FindRole("admin"), std::nullopt);
}

TEST(Role, OnlyOperatorsEditRoutesAndOnlyServersReceiptOrReply) {
  for (const Role role : AllRoles()) {
    const auto writes = RightsOf(role).write;
    const auto may = [&](Topic topic) {
      return std::find(writes.begin(), writes.end(), topic) != writes.end();
    };
    EXPECT_EQ(may(Topic::kRouteEdits), role == Role::kOperator) << NameOf(role);
    EXPECT_EQ(may(Topic::kNow), role == Role::kOperator || role == Role::kServer) << NameOf(role);
    EXPECT_EQ(may(Topic::kMissions), role == Role::kOperator || role == Role::kServer)
        << NameOf(role);
    EXPECT_EQ(may(Topic::kMissionReplies), role == Role::kServer) << NameOf(role);
    EXPECT_EQ(may(Topic::kNetworkEdits), role == Role::kOperator) << NameOf(role);
    EXPECT_EQ(may(Topic::kNetworkReplies), role == Role::kServer) << NameOf(role);
    EXPECT_EQ(may(Topic::kFollowed), role == Role::kFollower || role == Role::kScout)
        << NameOf(role);
    EXPECT_EQ(may(Topic::kReachReports), role != Role::kOperator && role != Role::kObserver)
        << NameOf(role);
    EXPECT_EQ(may(Topic::kStores), role == Role::kServer) << NameOf(role);
    EXPECT_EQ(may(Topic::kPhotos), role != Role::kOperator && role != Role::kObserver)
        << NameOf(role);
    EXPECT_EQ(may(Topic::kReceipts), role == Role::kServer) << NameOf(role);
    EXPECT_EQ(may(Topic::kCatalogReplies), role == Role::kServer) << NameOf(role);
  }
}

TEST(Role, AFollowerAnnouncesNoRoutesAndAnObserverOnlyAsks) {
  EXPECT_THAT(RightsOf(Role::kFollower).write, Not(Contains(Topic::kRoutes)));
  EXPECT_THAT(
      RightsOf(Role::kObserver).write,
      ElementsAre(Topic::kCatalogRequests, Topic::kMissionRequests, Topic::kSnapshotRequests,
                  Topic::kNetworkRequests, Topic::kReachRequests, Topic::kPhotoRequests));
}

TEST(Role, AllowsWhatItsProgramsOpenAndNamesWhatIsBeyond) {
  EXPECT_EQ(BeyondRights(Role::kServer, exchange::ServerTopics()), "");
  EXPECT_EQ(BeyondRights(Role::kScout, exchange::ScoutTopics()), "");
  EXPECT_EQ(BeyondRights(Role::kScout, exchange::FollowerTopics()), "");
  EXPECT_EQ(BeyondRights(Role::kFollower, exchange::FollowerTopics()), "");
  EXPECT_EQ(BeyondRights(Role::kOperator, exchange::OperatorTopics()), "");
  EXPECT_EQ(BeyondRights(Role::kObserver, exchange::ObserverTopics()), "");
  EXPECT_EQ(BeyondRights(Role::kOperator, exchange::DispatcherTopics()), "");
  EXPECT_EQ(BeyondRights(Role::kFollower, exchange::OnDutyTopics()), "");
  EXPECT_EQ(BeyondRights(Role::kScout, exchange::OnDutyTopics()), "");
  EXPECT_EQ(BeyondRights(Role::kOperator, exchange::SenderTopics()), "");
  EXPECT_EQ(BeyondRights(Role::kOperator, exchange::HistoryTopics()), "");
  EXPECT_EQ(BeyondRights(Role::kObserver, exchange::HistoryTopics()), "");
  EXPECT_EQ(BeyondRights(Role::kOperator, exchange::ReachTopics()), "");
  EXPECT_EQ(BeyondRights(Role::kObserver, exchange::ReachTopics()), "");
  EXPECT_THAT(BeyondRights(Role::kObserver, exchange::SenderTopics()),
              testing::HasSubstr("write trailcast/missions"));
  EXPECT_THAT(BeyondRights(Role::kObserver, exchange::DispatcherTopics()),
              testing::HasSubstr("write trailcast/now"));
  EXPECT_EQ(BeyondRights(Role::kFollower, exchange::ScoutTopics()),
            "write trailcast/routes, read trailcast/receipts");
  EXPECT_EQ(BeyondRights(Role::kObserver, exchange::OperatorTopics()),
            "write trailcast/route_edits");
}

TEST(Member, IsInItsCertificateAndItsPartition) {
  const Member member{Role::kScout, "4f2a9c0d11223344", 3};
  EXPECT_EQ(CommonNameOf(member), "scout.4f2a9c0d11223344.3");
  EXPECT_EQ(ParseCommonName(CommonNameOf(member)), member);
  EXPECT_EQ(PartitionOf(member), "scout/4f2a9c0d11223344");
  EXPECT_EQ(ParsePartition(PartitionOf(member)), (Member{Role::kScout, "4f2a9c0d11223344", 1}));
  EXPECT_EQ(ParsePartition("scout/4f2a9c0d11223344/1f"), ParsePartition(PartitionOf(member)));
  for (const char* wrong :
       {"", "scout", "scout.4f2a.3", "admin.4f2a9c0d11223344.3", "scout.4F2A9C0D11223344.3",
        "scout.4f2a9c0d11223344", "scout.4f2a9c0d11223344.", "scout.4f2a9c0d11223344.x",
        "scout.4f2a9c0d11223344.3.4"}) {
    EXPECT_EQ(ParseCommonName(wrong), std::nullopt) << wrong;
  }
  for (const char* wrong : {"", "*", "scout/*", "scout/4f2a9c0d11223344x", "scout"}) {
    EXPECT_EQ(ParsePartition(wrong), std::nullopt) << wrong;
  }
}

TEST(Member, ProcessesNamesAreTheMembers) {
  EXPECT_EQ(ProcessName("desk", 4711), "desk-p4711");
  EXPECT_EQ(WithoutProcess("desk-p4711"), "desk");
  for (const char* name : {"desk", "robot-1", "robot-p", "robot-pi", "p12", "-px1"}) {
    EXPECT_EQ(WithoutProcess(name), name);
  }
}

TEST(Member, TheIdTellsANameOnlyToWhoHasTheKey) {
  EXPECT_EQ(MemberIdOf("key", "robot1"), MemberIdOf("key", "robot1"));
  EXPECT_NE(MemberIdOf("key", "robot1"), MemberIdOf("key", "robot2"));
  EXPECT_NE(MemberIdOf("key", "robot1"), MemberIdOf("other", "robot1"));
}

}  // namespace
}  // namespace trailcast::security
