#include "services/security/documents.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace trailcast::security {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(Documents, TheGovernanceLetsNobodyInUnknownAndEncryptsAll) {
  const std::string xml = GovernanceXml();
  EXPECT_EQ(ElementOf(xml, "allow_unauthenticated_participants"), "false");
  EXPECT_EQ(ElementOf(xml, "enable_join_access_control"), "true");
  EXPECT_EQ(ElementOf(xml, "topic_expression"), "*");
  for (const char* kind :
       {"discovery_protection_kind", "liveliness_protection_kind", "metadata_protection_kind"}) {
    EXPECT_EQ(ElementOf(xml, kind), "ENCRYPT") << kind;
  }
  EXPECT_EQ(ElementOf(xml, "enable_write_access_control"), "true");
  EXPECT_EQ(ElementOf(xml, "enable_read_access_control"), "true");
}

TEST(Documents, PermissionsGrantARoleItsTopicsInItsPartitionUntilTheyEnd) {
  const Time from = std::chrono::system_clock::from_time_t(1'795'363'200);
  const std::string xml = PermissionsXml({Role::kFollower, "4f2a9c0d11223344", 2},
                                         {from, from + std::chrono::hours(1)});
  EXPECT_EQ(ElementOf(xml, "subject_name"), "CN=follower.4f2a9c0d11223344.2");
  EXPECT_EQ(ElementOf(xml, "not_before"), "2026-11-22T16:00:00Z");
  EXPECT_EQ(ElementOf(xml, "not_after"), "2026-11-22T17:00:00Z");
  EXPECT_EQ(ElementOf(xml, "default"), "DENY");
  const std::string publish = ElementOf(xml, "publish").value();
  EXPECT_EQ(ElementOf(publish, "partitions"),
            "<partition>follower/4f2a9c0d11223344</partition>"
            "<partition>follower/4f2a9c0d11223344/*</partition>");
  EXPECT_THAT(publish, HasSubstr("<topic>trailcast/segment_requests</topic>"));
  EXPECT_THAT(publish, Not(HasSubstr("trailcast/routes")));
  EXPECT_THAT(ElementOf(xml, "subscribe").value(), HasSubstr("<topic>trailcast/routes</topic>"));
}

TEST(Documents, ServersSpreadRevocationsAndAllHearThem) {
  const std::string topic = std::string("<topic>") + kRevocationsTopic + "</topic>";
  for (const Role role : AllRoles()) {
    const std::string xml = PermissionsXml({role, "4f2a9c0d11223344", 1}, {});
    EXPECT_EQ(ElementOf(xml, "publish")->find(topic) != std::string::npos, role == Role::kServer);
    EXPECT_THAT(ElementOf(xml, "subscribe").value(), HasSubstr(topic)) << NameOf(role);
    EXPECT_TRUE(AllowsTopic(xml, kRevocationsTopic));
    EXPECT_FALSE(AllowsTopic(xml, "trailcast/unknown"));
  }
}

TEST(Documents, AnElementThatIsThereTwiceIsNotRead) {
  EXPECT_EQ(ElementOf("<a>1</a><a>2</a>", "a"), std::nullopt);
  EXPECT_EQ(ElementOf("<a>1", "a"), std::nullopt);
  EXPECT_EQ(ElementOf("", "a"), std::nullopt);
}

}  // namespace
}  // namespace trailcast::security
