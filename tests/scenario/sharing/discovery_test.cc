// These test who finds whom on networks of different kinds, by flags and by the files of
// config/dds.
#include "tests/scenario/programs.h"
#include "tests/support/network_lab.h"
#include "tests/support/places.h"

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

  // With `settings` of the environment, a file of config/dds among them.
  std::unique_ptr<Process> StartAt(int host, const Words& settings, const std::string& program,
                                   const Words& words) {
    Words all{"/usr/bin/env"};
    all.insert(all.end(), settings.begin(), settings.end());
    all.push_back(ProgramsDir() + "/" + program);
    all.insert(all.end(), {"--dds-tag", tag_, "--network-interface", "eth0"});
    all.insert(all.end(), words.begin(), words.end());
    return std::make_unique<Process>(lab_->At(host, all), Path(program + std::to_string(host)));
  }
  static std::string File(const std::string& file) {
    return "CYCLONEDDS_URI=file://" + SourceDir() + "/config/dds/" + file;
  }
  void StartServer(const Words& settings) {
    server_ = StartAt(kServer, settings, "trailcast-server", {"--store", Path("server.db")});
    ASSERT_TRUE(server_->WaitForOutput("ready")) << server_->output();
  }
  // A scout teaches by the server, and a follower follows.
  void ExpectShared(const Words& settings) {
    const auto scout =
        StartAt(kScout, settings, "trailcast-agent",
                With(TeachWords(Walk("taught", kTaughtFrames), "scout.db"), {"--server"}));
    const auto taught = End(*scout);
    EXPECT_EQ(taught.status, 0) << taught.output;
    EXPECT_THAT(taught.output, HasSubstr("unreceipted=0"));
    const auto follower =
        StartAt(kFollower, settings, "trailcast-agent",
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
  StartServer({});
  ExpectShared({"TRAILCAST_DISCOVERY=star", "TRAILCAST_SERVER_ADDRESS=10.77.0.1"});
}

TEST_F(DiscoveryTest, WithoutMulticastNobodyIsFoundUnlessToldAnAddress) {
  lab_->ForbidMulticast();
  StartServer({});
  const auto lost = End(*StartAt(kFollower, {}, "trailcast", {"routes", "--timeout", "3"}));
  EXPECT_EQ(lost.status, 1);
  EXPECT_THAT(lost.output, HasSubstr("no route server answered"));
}

TEST_F(DiscoveryTest, WithMulticastAStarNeedsNoAddress) {
  StartServer({});
  ExpectShared({"TRAILCAST_DISCOVERY=star"});
}

class WithMulticast : public DiscoveryTest, public testing::WithParamInterface<const char*> {};

TEST_P(WithMulticast, NobodyNeedsAnAddress) {
  StartServer({File(GetParam())});
  ExpectShared({File(GetParam()), "TRAILCAST_DISCOVERY=star"});
}

INSTANTIATE_TEST_SUITE_P(Files, WithMulticast,
                         testing::Values("multicast.xml", "wifi.xml", "wired.xml", "vpn.xml"),
                         [](const auto& file) {
                           const std::string name = file.param;
                           return name.substr(0, name.find('.'));
                         });

}  // namespace
}  // namespace trailcast::test
