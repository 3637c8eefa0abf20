// A fleet with DDS Security at work: what its members may and what not, keys that are renewed and
// revoked, and what is seen on the wire.
#include <sys/utsname.h>

#include <functional>
#include <optional>

#include "services/store/sqlite_store.h"
#include "tests/scenario/sharing/secured_fleet.h"
#include "tests/support/network_lab.h"
#include "tests/support/strangers/old_keys.h"
#include "tests/support/strangers/sniffer.h"

namespace trailcast::test {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class SecurityTest : public SecuredFleetTest {
 protected:
  void CopyInto(const std::string& keys, const fs::path& file) {
    fs::copy_file(file, fs::path(keys) / file.filename(), fs::copy_options::overwrite_existing);
  }
};

TEST_F(SecurityTest, AFleetTeachesFollowsLooksAndEdits) {
  const auto server = SecuredServer();
  const Ended scout = Teach(scout_keys_);
  ASSERT_EQ(scout.status, 0) << scout.output;
  EXPECT_THAT(scout.output, HasSubstr("unreceipted=0"));
  const Ended follower =
      RunAs(follower_keys_, "trailcast-agent",
            With(ReplayWords(Walk("seen", kFollowerFrames), "follower.db"), {"--server"}));
  EXPECT_EQ(follower.status, 0) << follower.output;
  const Ended observer = RunAs(observer_keys_, "trailcast", {"routes", "--timeout", "20"});
  EXPECT_THAT(observer.output, AllOf(HasSubstr("hall"), HasSubstr("robot1"))) << observer.output;
  const Ended retired =
      RunAs(operator_keys_, "trailcast", {"routes", "retire", "hall", "--timeout", "20"});
  EXPECT_EQ(retired.status, 0) << retired.output;
  EXPECT_THAT(server->output(), Not(HasSubstr("kept out")));
}

TEST_F(SecurityTest, MembersWithKeysFromBeforeSegmentsHadScopesTakePart) {
  MakeOfBeforeScopes(authority_.folder(), scout_keys_);
  MakeOfBeforeScopes(authority_.folder(), server_keys_);
  const auto server = SecuredServer();
  EXPECT_THAT(server->output(), HasSubstr("trailcast keys renew server"));
  const Ended scout = Teach(scout_keys_);
  EXPECT_THAT(scout.output, HasSubstr("unreceipted=0")) << scout.output;
  const Ended follower = RunAs(follower_keys_, "trailcast-agent", FetchWords("follower.db"));
  EXPECT_EQ(follower.status, 0) << follower.output;
}

TEST_F(SecurityTest, EachRoleIsToldWhatItsKeysDoNotAllow) {
  const Ended follower = Teach(follower_keys_);
  EXPECT_EQ(follower.status, 1);
  EXPECT_THAT(follower.output,
              AllOf(HasSubstr("are of the role 'follower'"), HasSubstr("write trailcast/routes")));
  const Ended scout =
      RunAs(scout_keys_, "trailcast", {"routes", "delete", "hall", "--all-revisions"});
  EXPECT_EQ(scout.status, 1);
  EXPECT_THAT(scout.output, HasSubstr("write trailcast/route_edits"));
  const Ended observer = RunAs(observer_keys_, "trailcast", {"routes", "retire", "hall"});
  EXPECT_THAT(observer.output, HasSubstr("are of the role 'observer'"));
  for (const std::string& keys : {observer_keys_, follower_keys_, scout_keys_}) {
    const Ended sends = RunAs(keys, "trailcast", {"send", "robot1", "follow", "hall"});
    EXPECT_EQ(sends.status, 1);
    EXPECT_THAT(sends.output, HasSubstr("write trailcast/missions")) << keys;
  }
  const Ended other_name = RunAs(scout_keys_, "trailcast-agent",
                                 {"--name", "robot7", "deliver", "--store", Path("scout.db")});
  EXPECT_THAT(other_name.output, HasSubstr("are those of 'robot1', not of 'robot7'"));
}

TEST_F(SecurityTest, AnOperatorSendsAndAnObserverSeesWhatBecomesOfIt) {
  const auto server = SecuredServer();
  const Ended sent =
      RunAs(operator_keys_, "trailcast",
            {"send", "robot7", "follow", "hall", "--id", "trip", "--unheard", "--timeout", "20"});
  EXPECT_EQ(sent.status, 0) << sent.output;
  EXPECT_THAT(sent.output, HasSubstr("a server keeps it"));
  const Ended seen = RunAs(observer_keys_, "trailcast", {"missions", "--timeout", "20"});
  EXPECT_THAT(seen.output, AllOf(HasSubstr("trip"), HasSubstr("sent"))) << seen.output;
}

TEST_F(SecurityTest, AnOperatorIsAnsweredAboutTheNetworkAndAnObserverMayAsk) {
  const auto server = SecuredServer();
  ASSERT_EQ(Teach(scout_keys_).status, 0);
  const Ended closed =
      RunAs(operator_keys_, "trailcast", {"network", "close", "hall", "--timeout", "20"});
  EXPECT_THAT(closed.output,
              HasSubstr("server 'server': route 'hall' was taught without odometry"));
  const Ended asked = RunAs(observer_keys_, "trailcast", {"network", "--timeout", "20"});
  EXPECT_EQ(asked.status, 0) << asked.output;
  EXPECT_THAT(asked.output, HasSubstr("no routes are joined"));
  const Ended opens = RunAs(observer_keys_, "trailcast", {"network", "open", "hall"});
  EXPECT_EQ(opens.status, 1);
  EXPECT_THAT(opens.output, HasSubstr("write trailcast/network_edits"));
}

TEST_F(SecurityTest, ARevokedMemberIsKeptOutOfARunningFleetAndARenewedOneIsBack) {
  const auto server = SecuredServer();
  ASSERT_EQ(Teach(scout_keys_).status, 0);
  ASSERT_EQ(RunAs(follower_keys_, "trailcast-agent", FetchWords("before.db")).status, 0);
  // Stolen: the thief's copy knows nothing of the revocation.
  fs::copy(follower_keys_, folder_ / "stolen");
  ASSERT_TRUE(
      authority_.Revoke("robot2", Now()));  // into the folders here, the server's among them
  ASSERT_TRUE(server->WaitForOutput("joined anew")) << server->output();
  const Ended thief = RunAs(Path("stolen"), "trailcast-agent", FetchWords("stolen.db"));
  EXPECT_NE(thief.status, 0) << thief.output;
  const Ended own = RunAs(follower_keys_, "trailcast-agent", FetchWords("own.db"));
  EXPECT_THAT(own.output, HasSubstr("were revoked"));
  ASSERT_TRUE(authority_.Renew("robot2", {}, Now(), 30));
  const Ended renewed = RunAs(follower_keys_, "trailcast-agent", FetchWords("after.db"));
  EXPECT_EQ(renewed.status, 0) << renewed.output << server->output();
  EXPECT_THAT(server->output(), HasSubstr("kept out")) << server->output();
}

TEST_F(SecurityTest, TheKeysCommandDoesAllOfThat) {
  const auto keys = [&](const Words& words) {
    return End(*Start("trailcast", With({"keys", "--authority", Path("mine")}, words), "keys"));
  };
  EXPECT_EQ(keys({"add", "--role", "scout", "robot1"}).status, 1);
  ASSERT_EQ(keys({"init"}).status, 0);
  EXPECT_EQ(keys({"init"}).status, 1);
  EXPECT_THAT(keys({"add", "--role", "scout", "robot1"}).output, HasSubstr("members/robot1"));
  EXPECT_EQ(keys({"add", "--role", "king", "robot2"}).status, 2);
  const Ended renewed = keys({"renew", "--role", "follower", "robot1"});
  EXPECT_EQ(renewed.status, 0);
  EXPECT_THAT(renewed.output, HasSubstr("mine/revoked.pem")) << "its role before was another";
  EXPECT_THAT(keys({"revoke", "robot1"}).output, HasSubstr("mine/revoked.pem"));
  EXPECT_THAT(keys({"list"}).output, AllOf(HasSubstr("robot1  follower"), HasSubstr("revoked")));
  EXPECT_THAT(keys({"list", "--json"}).output, HasSubstr("\"generation\": 2"));
  EXPECT_THAT(keys({"revocations"}).output, HasSubstr("mine: list 3 of revoked keys (2 cert"));
  EXPECT_THAT(keys({"revocations", Path("mine/members/robot1")}).output, HasSubstr("list 3"));
  EXPECT_EQ(keys({"revocations", Path("nowhere")}).status, 1);
}

// All that passed the loopback interface while a route was taught and listed: an interface of a
// network of the test's own, as other tests announce themselves at the machine's.
class SnifferTest : public SecurityTest {
 protected:
  void SetUp() override {
    if (const std::string obstacle = NetworkLab::Obstacle(); !obstacle.empty()) {
      GTEST_SKIP() << obstacle;
    }
    network_.emplace();
  }
  std::string HeardWhile(const std::function<void()>& something) {
    Sniffer sniffer("lo");
    something();
    return sniffer.Stop();
  }
  // Cyclone's "host/version/system", in what it announces of itself.
  static std::string HostInAnnouncement() {
    utsname machine{};
    uname(&machine);
    return machine.nodename + std::string("/0.");
  }
  const std::string route_ = "sniff" + std::to_string(getpid()) + "route";
  const std::string scout_ = "sniff" + std::to_string(getpid()) + "scout";
  std::optional<NetworkLab> network_;
  Words TeachIt() {
    return {"teach",          "--frames", Walk("taught", kTaughtFrames),
            "--route",        route_,     "--store",
            Path("scout.db"), "--server"};
  }
};

TEST_F(SnifferTest, SeesNamesWithoutSecurity) {
  const std::string heard = HeardWhile([&] {
    const auto server = Server();
    EXPECT_EQ(RunAgent(With({"--name", scout_}, TeachIt())).status, 0);
  });
  EXPECT_NE(heard.find(route_), std::string::npos);
  EXPECT_NE(heard.find(scout_), std::string::npos);
  EXPECT_NE(heard.find(HostInAnnouncement()), std::string::npos);
}

TEST_F(SnifferTest, SeesNeitherNamesNorPayloadWithSecurity) {
  const std::string keys = Add(scout_, Role::kScout);
  const std::string heard = HeardWhile([&] {
    const auto server = SecuredServer();
    EXPECT_EQ(RunAs(keys, "trailcast-agent", TeachIt()).status, 0);
  });
  EXPECT_GT(heard.size(), 100'000U);  // what was taught did pass
  EXPECT_EQ(heard.find(route_), std::string::npos);
  EXPECT_EQ(heard.find(scout_), std::string::npos);
  EXPECT_EQ(heard.find(HostInAnnouncement()), std::string::npos);
  // The segments' bytes, which the scout's store has.
  const auto store = store::OpenSqliteStore(Path("scout.db"));
  ASSERT_TRUE(store);
  const auto routes = (*store)->QueryRoutes({});
  ASSERT_TRUE(routes);
  ASSERT_EQ(routes->routes.size(), 1U);
  const auto piece = (*store)->ReadSegment(routes->routes[0].key, SegmentIndex(0));
  ASSERT_TRUE(piece);
  const std::string bytes(piece->bytes.begin(), piece->bytes.end());
  EXPECT_EQ(heard.find(bytes.substr(bytes.size() / 2, 32)), std::string::npos);
}

}  // namespace
}  // namespace trailcast::test
