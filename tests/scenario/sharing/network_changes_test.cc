// Programs whose network is not there when they start, or changes while they run.
#include "services/store/route_store.h"
#include "tests/scenario/programs.h"
#include "tests/support/network_lab.h"

namespace trailcast::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

constexpr int kServer = 1;
constexpr int kRobot = 2;
constexpr int kElsewhere = 100;  // added to a host's address when it gets another

class NetworkChanges : public ProgramsTest {
 protected:
  void SetUp() override {
    if (const std::string obstacle = NetworkLab::Obstacle(); !obstacle.empty()) {
      GTEST_SKIP() << obstacle;
    }
    lab_.emplace();
    lab_->AddHostWithoutAddress(kServer);
    lab_->AddHostWithoutAddress(kRobot);
  }

  std::unique_ptr<Process> StartAt(int host, const std::string& program, const Words& words,
                                   const std::string& log) {
    return std::make_unique<Process>(lab_->At(host, With({ProgramsDir() + "/" + program}, words)),
                                     Path(log + ".log"));
  }
  Ended RunAt(int host, const std::string& program, const Words& words) {
    return End(*StartAt(host, program, words, "run" + std::to_string(++runs_)));
  }
  void StartServer(const Words& more = {}) {
    server_ = StartAt(
        kServer, "trailcast-server",
        With({"--store", Path("server.db"), "--http-port", "9464", "--heartbeat", Path("beat")},
             more),
        "server");
  }
  void StartServerOnItsNetwork() {
    lab_->GiveAddress(kServer, kServer);
    StartServer();
    ASSERT_TRUE(server_->WaitForOutput("ready")) << server_->output();
  }
  // Returns what the server says over HTTP, on its own machine.
  std::string Page(const std::string& path) {
    const std::string script =
        "exec 3<>/dev/tcp/127.0.0.1/9464; printf 'GET " + path + " HTTP/1.0\r\n\r\n' >&3; cat <&3";
    Process asks(lab_->At(kServer, {"/bin/bash", "-c", script}), Path("page"));
    (void)asks.Wait();
    return asks.output();
  }
  bool PageSays(const std::string& path, const std::string& what) {
    return WaitUntil([&] { return Page(path).find(what) != std::string::npos; });
  }
  // Some seventeen segments in as many seconds.
  std::unique_ptr<Process> Scout() {
    return StartAt(
        kRobot, "trailcast-agent",
        {"teach", "--sim", "indoor", "--camera", kSmallPictures, "--speed", "0.8", "--route",
         "hall", "--store", Path("scout.db"), "--server", "--delivery-timeout", "90"},
        "scout");
  }
  std::size_t HeldBy(const std::string& file) {
    auto store = store::OpenSqliteStore(Path(file));
    EXPECT_TRUE(store) << store.error().message;
    std::size_t held = 0;
    if (!store) return held;
    const auto routes = (*store)->ListRoutes().value();
    for (const route::RouteInfo& info : routes) {
      EXPECT_EQ(info.state, route::RouteState::kComplete);
      held += (*store)->HeldSegments(info.key).value().size();
    }
    return held;
  }
  void ExpectAllDelivered(Process& scout) {
    const auto ended = End(scout);
    EXPECT_EQ(ended.status, 0) << ended.output << server_->output();
    EXPECT_THAT(ended.output, HasSubstr("unreceipted=0"));
    server_->Signal(SIGTERM);
    EXPECT_EQ(server_->Wait(), 0);
    EXPECT_GT(HeldBy("scout.db"), 0U);
    EXPECT_EQ(HeldBy("server.db"), HeldBy("scout.db"));
  }
  // Where the words of a command at a host know 'server.example' by the file `hosts`.
  static Words Knowing(const std::string& hosts, const Words& words) {
    return With({"/usr/bin/unshare", "--mount", "--propagation", "private", "/bin/sh", "-c",
                 "mount --bind \"$0\" /etc/hosts && exec \"$@\"", hosts},
                words);
  }
  static int LinesWith(const std::string& text, const std::string& what) {
    int lines = 0;
    for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++lines;
    return lines;
  }

  std::optional<NetworkLab> lab_;
  std::unique_ptr<Process> server_;
  int runs_ = 0;
};

TEST_F(NetworkChanges, AServerStartedBeforeItsNetworkSaysSoAndIsFoundOnceThatIsThere) {
  lab_->GiveAddress(kRobot, kRobot);
  StartServer();
  ASSERT_TRUE(server_->WaitForOutput("waiting for the network")) << server_->output();
  EXPECT_TRUE(PageSays("/health", "503"));
  EXPECT_THAT(Page("/health"), HasSubstr("eth0 has no IPv4 address"));
  EXPECT_TRUE(PageSays("/metrics", "trailcast_on_network 0"));
  const Ended unwell = RunAt(kServer, "trailcast-server",
                             {"health", "--heartbeat", Path("beat"), "--store", Path("none.db")});
  EXPECT_EQ(unwell.status, 1) << unwell.output;
  EXPECT_THAT(unwell.output, HasSubstr("no network"));
  EXPECT_THAT(server_->output(), Not(HasSubstr("ready")));

  lab_->GiveAddress(kServer, kServer);
  ASSERT_TRUE(server_->WaitForOutput("ready")) << server_->output();
  EXPECT_EQ(LinesWith(server_->output(), "on the network by eth0 (10.77.0.1)"), 1);
  EXPECT_TRUE(PageSays("/health", "200"));
  EXPECT_TRUE(PageSays("/metrics", "trailcast_on_network 1"));
  const Ended found = RunAt(kRobot, "trailcast", {"routes"});
  EXPECT_EQ(found.status, 0) << found.output;
}

TEST_F(NetworkChanges, AScoutStartedBeforeItsNetworkDeliversOnceThatIsThere) {
  StartServerOnItsNetwork();
  const auto scout = StartAt(kRobot, "trailcast-agent",
                             With(TeachWords(Walk("taught", kTaughtFrames), "scout.db"),
                                  {"--server", "--delivery-timeout", "90"}),
                             "scout");
  ASSERT_TRUE(scout->WaitForOutput("no server heard yet")) << scout->output();
  lab_->GiveAddress(kRobot, kRobot);
  ExpectAllDelivered(*scout);
}

TEST_F(NetworkChanges, ACommandWithoutANetworkIsRefusedInWords) {
  const Ended refused = RunAt(kRobot, "trailcast", {"routes"});
  EXPECT_EQ(refused.status, 1);
  EXPECT_THAT(refused.output,
              AllOf(HasSubstr("eth0 has no IPv4 address"), HasSubstr("--network-interface lo")));
}

TEST_F(NetworkChanges, AMachineWithIPv6AloneIsToldThatDdsGoesByIPv4) {
  for (const int host : {kServer, kRobot}) {
    const std::string address = "fd77::" + std::to_string(host) + "/64";
    Process gives(lab_->At(host, {"ip", "-6", "address", "add", address, "dev", "eth0", "nodad"}),
                  Path("ip"));
    if (gives.Wait() != 0) GTEST_SKIP() << "this machine has no IPv6: " << gives.output();
  }
  const std::string why = "eth0 has an IPv6 address alone, and DDS goes by IPv4 here";
  StartServer();
  ASSERT_TRUE(server_->WaitForOutput("waiting for the network")) << server_->output();
  EXPECT_THAT(server_->output(), AllOf(HasSubstr(why), Not(HasSubstr("ready"))));
  EXPECT_TRUE(PageSays("/health", "503"));
  EXPECT_THAT(Page("/health"), HasSubstr(why));
  const Ended refused = RunAt(kRobot, "trailcast", {"routes"});
  EXPECT_EQ(refused.status, 1);
  EXPECT_THAT(refused.output, HasSubstr(why));
}

TEST_F(NetworkChanges, ARobotThatGetsAnotherAddressDeliversTheRest) {
  StartServerOnItsNetwork();
  lab_->GiveAddress(kRobot, kRobot);
  const auto scout = Scout();
  ASSERT_TRUE(server_->WaitForOutput("segments stored and acknowledged")) << scout->output();
  lab_->TakeAddress(kRobot, kRobot);
  lab_->GiveAddress(kRobot, kRobot + kElsewhere);
  ASSERT_TRUE(scout->WaitForOutput("instead of eth0 (10.77.0.2)")) << scout->output();
  ExpectAllDelivered(*scout);
}

TEST_F(NetworkChanges, AServerThatGetsAnotherAddressIsFoundAgain) {
  StartServerOnItsNetwork();
  lab_->GiveAddress(kRobot, kRobot);
  const auto scout = Scout();
  ASSERT_TRUE(server_->WaitForOutput("segments stored and acknowledged")) << scout->output();
  lab_->TakeAddress(kServer, kServer);
  lab_->GiveAddress(kServer, kServer + kElsewhere);
  ASSERT_TRUE(server_->WaitForOutput("instead of eth0 (10.77.0.1)")) << server_->output();
  EXPECT_TRUE(PageSays("/metrics", "trailcast_network_joins_total 2"));
  ExpectAllDelivered(*scout);
}

TEST_F(NetworkChanges, AServerThatARobotKnowsByNameIsFollowedToItsOtherAddress) {
  StartServerOnItsNetwork();
  lab_->GiveAddress(kRobot, kRobot);
  lab_->ForbidMulticast();
  const std::string hosts = Path("hosts");
  std::ofstream(hosts) << "10.77.0.1 server.example\n";
  const Words follower = With({ProgramsDir() + "/trailcast-agent"},
                              With(ReplayWords(Walk("seen", 2), "follower.db"),
                                   {"--name", "robot1", "--server", "--wait-for-route",
                                    "--discovery", "star", "--server-address", "server.example"}));
  Process robot(lab_->At(kRobot, Knowing(hosts, follower)), Path("robot.log"));
  ASSERT_TRUE(robot.WaitForOutput("server 'server' is there")) << robot.output();

  lab_->TakeAddress(kServer, kServer);
  lab_->GiveAddress(kServer, kServer + kElsewhere);
  ASSERT_TRUE(server_->WaitForOutput("instead of eth0 (10.77.0.1)")) << server_->output();
  std::ofstream(hosts) << "10.77.0.101 server.example\n";
  ASSERT_TRUE(robot.WaitForOutput("'server.example' leads to 10.77.0.101 now instead of 10.77.0.1"))
      << robot.output();
  const Ended reach =
      RunAt(kServer, "trailcast",
            {"reach", "server", "robot1", "--listen", "100", "--server-address", "10.77.0.101"});
  EXPECT_EQ(reach.status, 0) << reach.output << robot.output();
}

TEST_F(NetworkChanges, AnInterfaceThatIsMadeAnewIsJoinedAnew) {
  StartServerOnItsNetwork();
  lab_->GiveAddress(kRobot, kRobot);
  const auto scout = Scout();
  ASSERT_TRUE(server_->WaitForOutput("segments stored and acknowledged")) << scout->output();
  lab_->DeleteInterface(kRobot);
  ASSERT_TRUE(scout->WaitForOutput("off the network, eth0 (10.77.0.2) is gone")) << scout->output();
  lab_->MakeInterface(kRobot);
  lab_->GiveAddress(kRobot, kRobot);
  ExpectAllDelivered(*scout);
}

TEST_F(NetworkChanges, ARobotOnAMissionGoesOnWhenItsAddressChangesAndIsHeardAndHearsAgain) {
  StartServerOnItsNetwork();
  lab_->GiveAddress(kRobot, kRobot);
  const Ended taught = RunAt(kRobot, "trailcast-agent",
                             {"teach", "--sim", "indoor", "--camera", kSmallPictures, "--route",
                              "hall", "--store", Path("robot.db")});
  ASSERT_EQ(taught.status, 0) << taught.output;
  const auto robot = StartAt(kRobot, "trailcast-agent",
                             {"serve", "--sim", "indoor", "--camera", kSmallPictures, "--name",
                              "robot1", "--store", Path("robot.db")},
                             "robot");
  ASSERT_TRUE(robot->WaitForOutput("available as 'robot1'")) << robot->output();
  const Words trip{"send", "robot1", "follow", "hall", "..6", "--id", "trip"};
  const Ended sent = RunAt(kServer, "trailcast", trip);
  ASSERT_EQ(sent.status, 0) << sent.output << robot->output();
  ASSERT_TRUE(robot->WaitForOutput("segment 1: ")) << robot->output();
  lab_->TakeAddress(kRobot, kRobot);
  lab_->GiveAddress(kRobot, kRobot + kElsewhere);
  ASSERT_TRUE(robot->WaitForOutput("instead of eth0 (10.77.0.2)")) << robot->output();
  const Ended arrived = RunAt(kServer, "trailcast", With(trip, {"--wait"}));
  EXPECT_EQ(arrived.status, 0) << arrived.output << robot->output();
  EXPECT_THAT(arrived.output, HasSubstr("robot1: arrived"));
  const Ended stopped = RunAt(kServer, "trailcast", {"stop", "robot1", "--timeout", "30"});
  EXPECT_EQ(stopped.status, 0) << stopped.output << robot->output();
  EXPECT_EQ(LinesWith(robot->output(), "on the network"), 1) << robot->output();
}

}  // namespace
}  // namespace trailcast::test
