// A fleet in which keys are revoked: the list is copied to the server, which gives it to all
// others.
#include <optional>

#include "services/base/durable_file.h"
#include "services/dds/src/domain/domain_config.h"
#include "services/dds/src/revocation_topic.h"
#include "services/security/revocation_list.h"
#include "services/security/src/files.h"
#include "tests/scenario/sharing/secured_fleet.h"
#include "tests/support/strangers/old_keys.h"

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
    ASSERT_TRUE(Replace(server_, ListOf(authority_.folder())));
  }
  static std::string ListOf(const fs::path& folder) {
    return security::ReadSmallFile(folder / "revoked.pem").value();
  }
  static Result<void> Replace(const std::string& keys, const std::string& list) {
    return ReplaceFile(fs::path(keys) / "revoked.pem", list);
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

  const std::string first_list_ = ListOf(authority_.folder());
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

TEST_F(RevocationTest, WhoWasAwayGetsTheListWhenItMeetsTheServerOperatorsAndOtherServersToo) {
  RevokeAndTellTheServer("robot1");
  const auto server = ServerOfCopies("server");
  const auto robot = Robot2("robot");
  EXPECT_TRUE(robot->WaitForOutput("joined anew")) << robot->output();
  EXPECT_EQ(ListIn(robot2_), 2U);
  const std::string second = Add("server2", Role::kServer);
  ASSERT_TRUE(Replace(second, first_list_));
  const auto other = StartAs(second, "trailcast-server", {"--store", Path("second.db")}, "second");
  EXPECT_TRUE(other->WaitForOutput("joined anew")) << other->output();
  EXPECT_EQ(ListIn(second), 2U);
  const std::string desk = CopyOf("desk");
  ASSERT_TRUE(Replace(desk, first_list_));
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
  ASSERT_TRUE(Replace(robot2_, ListOf(authority_.folder())));
  const auto server = ServerOfCopies("server");
  const auto robot = Robot2("robot");
  EXPECT_TRUE(robot->WaitForOutput("refused what server/")) << robot->output();
  EXPECT_THAT(robot->output(), AllOf(HasSubstr("list 1 of revoked keys"), HasSubstr("is older")));
  EXPECT_EQ(ListIn(robot2_), 2U);
  EXPECT_EQ(ListIn(server_), 1U);
}

// A server's program that sends anything as the list; DDS itself is given its right one.
class LyingServer {
 public:
  LyingServer(const std::string& tag, const std::string& keys_folder, const std::string& list)
      : keys_(security::LoadMemberKeys(keys_folder, std::chrono::system_clock::now()).value()),
        domain_(dds::Domain::Create(dds::DomainConfig(Options(tag), {}, "").value()).value()),
        participant_(dds::Participant::Create(domain_, "").value()),
        wait_set_(dds::WaitSet::Create(participant_).value()) {
    keys_.revoked.text = list;
    topic_ = dds::RevocationTopic::Open(participant_, wait_set_, keys_).value();
  }

 private:
  dds::DdsOptions Options(const std::string& tag) const {
    dds::DdsOptions options;
    options.discovery_tag = tag;
    options.network_interface = "lo";
    options.keys = keys_;
    return options;
  }
  security::MemberKeys keys_;
  dds::Domain domain_;
  dds::Participant participant_;
  dds::WaitSet wait_set_;
  std::optional<dds::RevocationTopic> topic_;
};

TEST_F(RevocationTest, WhatIsNoListOfTheAuthoritysIsRefusedAndNothingIsWritten) {
  const auto other = security::Authority::Create(folder_ / "other", LongAgo(), 3650).value();
  ASSERT_TRUE(other.Add("robot1", Role::kScout, LongAgo(), 30));
  ASSERT_TRUE(other.Revoke("robot1", Now()));
  const std::string version = security::KeysVersion(robot2_);
  const auto server = ServerOfCopies("server");
  const auto robot = Robot2("robot");
  const std::string second = Add("server2", Role::kServer);
  const std::pair<std::string, const char*> kLists[] = {
      {ListOf(other.folder()), "was not signed by the fleet's authority"},
      {"-----BEGIN X509 CRL-----\nAAAA\n", "is no revocation list"},
      {first_list_ + std::string(security::kMaxRevocationListBytes, '\n'), "is longer than"}};
  for (const auto& [list, why] : kLists) {
    const LyingServer liar(tag_, second, list);
    EXPECT_TRUE(robot->WaitForOutput(why)) << robot->output();
  }
  EXPECT_THAT(robot->output(), Not(HasSubstr("joined anew")));
  EXPECT_EQ(security::KeysVersion(robot2_), version);
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
