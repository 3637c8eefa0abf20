#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "services/dds/src/domain/domain_config.h"
#include "tests/contract/network.h"

namespace trailcast::dds {
namespace {

using exchange::AgentStatus;
using exchange::Message;
using testing::HasSubstr;

TEST(DomainConfig, GivesTheLastWordToTheExtraConfiguration) {
  DdsOptions options;
  options.domain_id = 17;
  options.network_interface = "lo";
  options.extra_config_xml = "<extra/>";
  const std::string config = DomainConfig(options, {}, "<environment/>").value();
  const auto environment = config.find("<environment/>");
  const auto domain = config.find("<ExternalDomainId>17</ExternalDomainId>");
  const auto extra = config.find("<extra/>");
  EXPECT_LT(config.find("NackDelay"), environment);
  EXPECT_LT(environment, domain);
  EXPECT_LT(domain, extra);
  EXPECT_NE(extra, std::string::npos);
}

TEST(DomainConfig, PacketsFitAFrameOfTheNetwork) {
  DdsOptions options;
  EXPECT_THAT(DomainConfig(options, {}, "").value(), HasSubstr("<MaxMessageSize>1400B<"));
  options.network_interface = "lo";  // whose frames are large
  EXPECT_THAT(DomainConfig(options, {}, "").value(), testing::Not(HasSubstr("MaxMessageSize")));
}

TEST(DomainConfig, LetsTheEnvironmentForbidMulticastOnTheChosenInterface) {
  DdsOptions options;
  options.network_interface = "eth0";
  const std::string config = DomainConfig(options, {}, "<environment/>").value();
  EXPECT_LT(config.find("<AllowMulticast>true<"), config.find("<environment/>"));
  EXPECT_EQ(config.find("AllowMulticast", config.find("<environment/>")), std::string::npos);
}

TEST(DomainConfig, RefusesWhatCannotBeConfigured) {
  DdsOptions options;
  options.domain_id = 231;
  EXPECT_THAT(DomainConfig(options, {}, "").error().message, HasSubstr("231"));
  options = {};
  options.discovery_tag = "</Tag>";
  EXPECT_THAT(DomainConfig(options, {}, "").error().message, HasSubstr("tag"));
  options = {};
  options.network_interface = "eth0\"/>";
  EXPECT_THAT(DomainConfig(options, {}, "").error().message, HasSubstr("interface"));
}

TEST(DomainConfig, WithKeysTheMembersFilesAreUsed) {
  DdsOptions options;
  options.keys = security::MemberKeys{.folder = "/keys/robot1", .revoked = {.text = "a list"}};
  const std::string config = DomainConfig(options, {}, "").value();
  for (const char* file :
       {"authority.pem", "identity.pem", "identity.key", "governance.p7s", "permissions.p7s"}) {
    EXPECT_THAT(config, HasSubstr(std::string("file:/keys/robot1/") + file));
  }
  EXPECT_THAT(config, HasSubstr("<CRL>data:,a list</CRL>"));  // perhaps newer than the file
  options.keys->folder = "/keys/<robot1>";
  EXPECT_THAT(DomainConfig(options, {}, "").error().message, HasSubstr("folder"));
}

TEST(OpenDdsExchange, FailsWithAHintWhenTheInterfaceDoesNotExist) {
  DdsOptions options = test::LoopbackOptions(test::UniqueTag());
  options.network_interface = "nosuch0";
  const auto opened = OpenDdsExchange(options, exchange::OperatorTopics());
  ASSERT_FALSE(opened);
  EXPECT_THAT(opened.error().message, HasSubstr("network interface"));
}

TEST(OpenDdsExchange, KeepsSwarmsOfDifferentTagsApart) {
  const auto open = [](const std::string& tag) {
    return OpenDdsExchange(test::LoopbackOptions(tag), test::EveryTopic()).value();
  };
  const std::string tag = test::UniqueTag();
  const auto writer = open(tag);
  const auto stranger = open(test::UniqueTag());
  const auto reader = open(tag);
  ASSERT_TRUE(writer->Publish(AgentStatus{.agent = AgentId("robot-1")}));
  bool heard = false;
  ASSERT_TRUE(test::TakeUntil(
      *reader, [&](const Message&) { heard = true; }, [&] { return heard; }));
  EXPECT_TRUE(stranger->Take(std::chrono::milliseconds(200)).empty());
}

}  // namespace
}  // namespace trailcast::dds
