// A fleet in which keys are revoked: the list is copied to the server, which gives it to all
// others.
#include "services/security/revocation_list.h"
#include "tests/scenario/secured_fleet.h"
#include "tests/support/old_keys.h"

namespace trailcast::test {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

// Each member's keys are a copy, as on its own machine: the authority's folder is nobody's.
class RevocationTest : public SecuredFleetTest {
 protected:
  std::string CopyOf(const std::string& name) {
    fs::copy(Keys(name), Path("keys-of-" + name));
    return Path("keys-of-" + name);
  }
  void RevokeAndTellTheServer(const std::string& name) {
    ASSERT_TRUE(authority_.Revoke(name, Now()));
    fs::copy_file(authority_.RevocationFile(), fs::path(server_) / "revoked.pem",
                  fs::copy_options::overwrite_existing);
  }
  std::unique_ptr<Process> ServerOfCopies(const std::string& log) {
    auto server = StartAs(server_, "trailcast-server", {"--store", Path("server.db")}, log);
    EXPECT_TRUE(server->WaitForOutput("ready")) << server->output();
    return server;
  }
  // Waits for a route that nobody teaches. Meets everybody: not only the server keeps others out.
  std::unique_ptr<Process> Robot2(const std::string& log) {
    const Words waits{"--discovery",     "mesh",     "replay",          "--frames",
                      Walk("seen", 1),   "--route",  "attic",           "--store",
                      Path("robot2.db"), "--server", "--wait-for-route"};
    auto robot = StartAs(robot2_, "trailcast-agent", waits, log);
    EXPECT_TRUE(robot->WaitForOutput("server 'server' is there")) << robot->output();
    return robot;
  }
  Ended Thief(const std::string& store) {
    return RunAs(robot1_, "trailcast-agent", With({"--discovery", "mesh"}, FetchWords(store)));
  }
  static std::uint64_t ListIn(const std::string& keys) {
    return security::RevocationListIn(keys)->number;
  }

  const std::string server_ = CopyOf("server");
  const std::string robot1_ = CopyOf("robot1");
  const std::string robot2_ = CopyOf("robot2");
};

TEST_F(RevocationTest, TheServerGivesTheListToAllOthersAndItStays) {
  auto server = ServerOfCopies("server");
  ASSERT_EQ(Teach(robot1_).status, 0);
  auto robot = Robot2("robot");
  RevokeAndTellTheServer("robot1");
  ASSERT_TRUE(server->WaitForOutput("joined anew")) << server->output();
  ASSERT_TRUE(robot->WaitForOutput("list 2 of revoked keys")) << robot->output();
  ASSERT_TRUE(robot->WaitForOutput("joined anew")) << robot->output();
  EXPECT_EQ(ListIn(robot2_), 2U);
  EXPECT_EQ(ListIn(robot1_), 1U);
  const Ended thief = Thief("stolen.db");
  EXPECT_NE(thief.status, 0) << thief.output;
  for (Process* each : {server.get(), robot.get()}) {
    EXPECT_TRUE(each->WaitForOutput("its keys were revoked")) << each->output();
  }
  // All that is started anew goes on with it.
  server.reset();
  robot.reset();
  server = ServerOfCopies("server-again");
  robot = Robot2("robot-again");
  const Ended again = Thief("stolen-again.db");
  EXPECT_NE(again.status, 0) << again.output;
  for (Process* each : {server.get(), robot.get()}) {
    EXPECT_TRUE(each->WaitForOutput("its keys were revoked")) << each->output();
    EXPECT_THAT(each->output(), Not(HasSubstr("list 2 of revoked keys"))) << "it had that already";
  }
}

TEST_F(RevocationTest, WhoWasAwayGetsTheListWhenItMeetsTheServerOperatorsToo) {
  ASSERT_TRUE(authority_.Revoke("robot1", Now()));
  fs::copy_file(authority_.RevocationFile(), fs::path(server_) / "revoked.pem",
                fs::copy_options::overwrite_existing);
  const auto server = ServerOfCopies("server");
  const auto robot = Robot2("robot");
  EXPECT_TRUE(robot->WaitForOutput("joined anew")) << robot->output();
  EXPECT_EQ(ListIn(robot2_), 2U);
  const std::string desk = CopyOf("desk");
  // A command may be over before the list came to it; one of the next has it.
  for (int i = 0; i < 10 && ListIn(desk) == 1; ++i) {
    const Ended routes = RunAs(desk, "trailcast", {"routes", "--timeout", "20"});
    EXPECT_EQ(routes.status, 0) << routes.output;
  }
  EXPECT_EQ(ListIn(desk), 2U);
}

TEST_F(RevocationTest, WhereTheFolderCannotBeWrittenTheListHoldsForTheRun) {
  const auto server = ServerOfCopies("server");
  const auto robot = Robot2("robot");
  // Nobody, root neither, writes a file where a folder with things in it is.
  const std::string fresh = "revoked.pem." + std::to_string(robot->pid()) + ".new";
  fs::create_directories(fs::path(robot2_) / fresh / "inside");
  RevokeAndTellTheServer("robot1");
  ASSERT_TRUE(robot->WaitForOutput("holds for this run alone")) << robot->output();
  ASSERT_TRUE(robot->WaitForOutput("joined anew")) << robot->output();
  EXPECT_EQ(ListIn(robot2_), 1U);
  EXPECT_NE(Thief("stolen.db").status, 0);
  EXPECT_TRUE(robot->WaitForOutput("its keys were revoked")) << robot->output();
}

TEST_F(RevocationTest, AServerThatComesBackWithAnOlderListTakesNothingBack) {
  ASSERT_TRUE(authority_.Revoke("robot1", Now()));
  fs::copy_file(authority_.RevocationFile(), fs::path(robot2_) / "revoked.pem",
                fs::copy_options::overwrite_existing);
  const auto server = ServerOfCopies("server");
  const auto robot = Robot2("robot");
  EXPECT_TRUE(robot->WaitForOutput("refused what server/")) << robot->output();
  EXPECT_THAT(robot->output(), AllOf(HasSubstr("list 1 of revoked keys"), HasSubstr("is older")));
  EXPECT_EQ(ListIn(robot2_), 2U);
  EXPECT_EQ(ListIn(server_), 1U);
}

TEST_F(RevocationTest, MembersWithKeysFromBeforeServersSpreadListsTakePart) {
  MakeOfBeforeRevocations(authority_.folder(), robot2_);
  const auto server = ServerOfCopies("server");
  ASSERT_EQ(Teach(robot1_).status, 0);
  const Ended follower = RunAs(robot2_, "trailcast-agent", FetchWords("robot2.db"));
  EXPECT_EQ(follower.status, 0) << follower.output;
  EXPECT_THAT(follower.output, HasSubstr("trailcast keys renew robot2"));
  EXPECT_THAT(server->output(), Not(HasSubstr("kept out")));
}

}  // namespace
}  // namespace trailcast::test
