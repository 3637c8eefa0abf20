// The files of config/dds, each on a network of the kind that it is for.
#include "tests/scenario/programs.h"
#include "tests/support/network_lab.h"

namespace trailcast::test {
namespace {

using testing::HasSubstr;

constexpr int kServer = 1;
constexpr int kScout = 2;
constexpr int kFollower = 3;

class DiscoveryTest : public ProgramsTest {
 protected:
  void SetUp() override {
    if (const std::string obstacle = NetworkLab::Obstacle(); !obstacle.empty()) {
      GTEST_SKIP() << obstacle;
    }
    lab_.emplace();
    for (const int host : {kServer, kScout, kFollower}) lab_->AddHost(host);
  }

  // With a file of config/dds; none: as it is.
  std::unique_ptr<Process> StartAt(int host, const std::string& file, const std::string& program,
                                   const Words& words) {
    Words all{"/usr/bin/env", "TRAILCAST_SERVER_ADDRESS=10.77.0.1"};
    if (!file.empty()) {
      all.push_back("CYCLONEDDS_URI=file://" + std::string(TRAILCAST_SOURCE_DIR) + "/config/dds/" +
                    file);
    }
    all.push_back(std::string(TRAILCAST_BINARY_DIR) + "/" + program);
    all.insert(all.end(), {"--dds-tag", tag_, "--network-interface", "eth0"});
    all.insert(all.end(), words.begin(), words.end());
    return std::make_unique<Process>(lab_->At(host, all), Path(program + std::to_string(host)));
  }
  void StartServer(const std::string& file) {
    server_ = StartAt(kServer, file, "trailcast-server", {"--store", Path("server.db")});
    ASSERT_TRUE(server_->WaitForOutput("ready")) << server_->output();
  }
  // A scout teaches by the server, and a follower follows.
  void ExpectShared(const std::string& file) {
    const auto scout =
        StartAt(kScout, file, "trailcast-agent",
                With(TeachWords(Walk("taught", kTaughtFrames), "scout.db"), {"--server"}));
    const auto taught = End(*scout);
    EXPECT_EQ(taught.status, 0) << taught.output;
    EXPECT_THAT(taught.output, HasSubstr("unreceipted=0"));
    const auto follower =
        StartAt(kFollower, file, "trailcast-agent",
                With(ReplayWords(Walk("seen", kFollowerFrames), "follower.db"), {"--server"}));
    const auto followed = End(*follower);
    EXPECT_EQ(followed.status, 0) << followed.output;
    EXPECT_THAT(followed.output, HasSubstr("state=ARRIVED"));
  }

  std::optional<NetworkLab> lab_;
  std::unique_ptr<Process> server_;
};

TEST_F(DiscoveryTest, WithoutMulticastTheServersAddressIsEnough) {
  lab_->ForbidMulticast();
  StartServer("unicast-server.xml");
  ExpectShared("unicast-agent.xml");
}

TEST_F(DiscoveryTest, WithoutMulticastNobodyIsFoundUnlessToldAnAddress) {
  lab_->ForbidMulticast();
  StartServer("");
  const auto lost = End(*StartAt(kFollower, "", "trailcast", {"routes", "--timeout", "3"}));
  EXPECT_EQ(lost.status, 1);
  EXPECT_THAT(lost.output, HasSubstr("no route server answered"));
}

class WithMulticast : public DiscoveryTest, public testing::WithParamInterface<const char*> {};

TEST_P(WithMulticast, NobodyNeedsAnAddress) {
  StartServer(GetParam());
  ExpectShared(GetParam());
}

INSTANTIATE_TEST_SUITE_P(Files, WithMulticast, testing::Values("multicast.xml", "wifi.xml"),
                         [](const auto& file) {
                           const std::string name = file.param;
                           return name.substr(0, name.find('.'));
                         });

}  // namespace
}  // namespace trailcast::test
