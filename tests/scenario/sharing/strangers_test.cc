// Strangers at a fleet with DDS Security: each gets nothing, the fleet does not notice, and the
// server's log tells once who was kept out and why.
#include "services/base/durable_file.h"
#include "services/security/src/files.h"
#include "services/security/src/signing.h"
#include "services/store/sqlite_store.h"
#include "tests/scenario/sharing/secured_fleet.h"
#include "tests/support/await.h"
#include "tests/support/pieces.h"
#include "tests/support/places.h"
#include "tests/support/strangers/stranger.h"

namespace trailcast::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

std::size_t CountOf(const std::string& text, const std::string& word) {
  std::size_t count = 0;
  for (auto at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++count;
  return count;
}

class StrangersTest : public SecuredFleetTest {
 protected:
  Result<std::unique_ptr<exchange::RouteExchange>> Join(const std::string& keys,
                                                        const exchange::TopicUse& use) {
    dds::DdsOptions network;
    network.discovery_tag = tag_;
    network.network_interface = "lo";
    network.tell_of_stranger = [this](const std::string& line) { told_ += line + "\n"; };
    // Strangers may know the fleet's name key, too.
    if (!keys.empty()) network.keys = Stranger::AtTheirWord(keys, authority_.folder() / "name.key");
    return Stranger::Join(network, use);
  }
  // It is told of, once, within the watch's patience and some seconds.
  static void ExpectKeptOutOnce(Process& server, const std::string& why) {
    EXPECT_TRUE(server.WaitForOutput("kept out")) << server.output();
    EXPECT_EQ(CountOf(server.output(), "kept out"), 1U) << server.output();
    EXPECT_THAT(server.output(), HasSubstr(why));
  }
  // Returns what robot1 taught.
  route::RouteInfo Taught() {
    const auto store = store::OpenSqliteStore(Path("scout.db"));
    return (*store)->QueryRoutes({})->routes.at(0);
  }
  // Says it again and again: the first ones come before both ends have met.
  static void PublishUntil(exchange::RouteExchange& stranger, const exchange::Message& message,
                           Process& server, const std::string& told) {
    const auto deadline = std::chrono::steady_clock::now() + test::kLongEnough;
    while (server.output().find(told) == std::string::npos) {
      ASSERT_LT(std::chrono::steady_clock::now(), deadline) << server.output();
      (void)stranger.Publish(message);
      (void)stranger.Take(std::chrono::milliseconds(200));
    }
  }
  void ExpectFleetAtWork() {
    const Ended fetched = RunAs(follower_keys_, "trailcast-agent", FetchWords("after.db"));
    EXPECT_EQ(fetched.status, 0) << fetched.output;
  }

  std::string told_;                                // to the stranger, by its own exchange
  static constexpr std::chrono::seconds kStay{13};  // the watch takes ten to be sure
};

TEST_F(StrangersTest, APlaintextParticipantHearsNothing) {
  const auto server = SecuredServer();
  ASSERT_EQ(Teach(scout_keys_).status, 0);
  const auto stranger = Join("", exchange::OperatorTopics());
  ASSERT_TRUE(stranger) << stranger.error().message;
  EXPECT_EQ(Stranger::HeardBy(**stranger, kStay), 0U);
  ExpectKeptOutOnce(*server, "calling itself 'stranger'");
  ExpectFleetAtWork();
}

TEST_F(StrangersTest, KeysOfAnotherAuthorityOpenNothing) {
  const auto server = SecuredServer();
  ASSERT_EQ(Teach(scout_keys_).status, 0);
  const auto other = security::Authority::Create(folder_ / "other", Now(), 30).value();
  const std::string keys = other.Add("desk", Role::kOperator, Now(), 30)->string();
  const auto stranger = Join(keys, exchange::OperatorTopics());
  ASSERT_TRUE(stranger) << stranger.error().message;
  EXPECT_EQ(Stranger::HeardBy(**stranger, kStay), 0U);
  ExpectKeptOutOnce(*server, "of another authority");
  ExpectFleetAtWork();
}

TEST_F(StrangersTest, ExpiredKeysDoNotEvenGetToTheNetwork) {
  const auto server = SecuredServer();
  const std::string keys = authority_.Add("old", Role::kOperator, LongAgo(), 10)->string();
  const Ended refused = RunAs(keys, "trailcast", {"routes"});
  EXPECT_EQ(refused.status, 1);
  EXPECT_THAT(refused.output, HasSubstr("expired on"));
  const auto stranger = Join(keys, exchange::OperatorTopics());
  ASSERT_FALSE(stranger);
  EXPECT_THAT(stranger.error().message, HasSubstr("certificate has expired"));
}

// On a machine whose clock is five days further back than the keys' end.
TEST_F(StrangersTest, ExpiredKeysAreNotBelievedBecauseTheirOwnersClockIsBehind) {
  constexpr const char* kFakeTime = "/usr/lib/x86_64-linux-gnu/faketime/libfaketime.so.1";
  if (!fs::exists(kFakeTime)) GTEST_SKIP() << "needs package libfaketime";
  const auto server = SecuredServer();
  ASSERT_EQ(Teach(scout_keys_).status, 0);
  const std::string keys = authority_.Add("old", Role::kOperator, LongAgo(), 10)->string();
  Process late({"/usr/bin/env", "LD_PRELOAD=" + std::string(kFakeTime), "FAKETIME=-15d",
                "FAKETIME_DONT_FAKE_MONOTONIC=1", ProgramsDir() + "/trailcast", "--dds-tag", tag_,
                "--network-interface", "lo", "--security", keys, "routes", "--timeout",
                std::to_string(kStay.count())},
               Path("late.log"));
  const Ended ended = End(late);
  EXPECT_EQ(ended.status, 1);
  EXPECT_THAT(ended.output, HasSubstr("no route server answered"));
  ExpectKeptOutOnce(*server, "its keys have expired");
  ExpectFleetAtWork();
}

TEST_F(StrangersTest, KeysThatExpireMeanwhileAreGoodForNothingMore) {
  const auto server = SecuredServer();
  ASSERT_EQ(Teach(scout_keys_).status, 0);
  constexpr std::chrono::seconds kLeft{6};
  const auto nearly_a_day_ago = Now() - std::chrono::hours(24) + kLeft;
  const std::string keys = authority_.Add("brief", Role::kOperator, nearly_a_day_ago, 1)->string();
  const auto stranger = Join(keys, exchange::OperatorTopics());
  ASSERT_TRUE(stranger) << stranger.error().message;
  EXPECT_GT(Stranger::HeardBy(**stranger, kLeft, "brief"), 0U) << "was no member before";
  // This takes what was under way.
  (void)(*stranger)->Take(std::chrono::milliseconds(500));
  (void)(*stranger)->Take(std::chrono::milliseconds(500));
  EXPECT_EQ(Stranger::HeardBy(**stranger, std::chrono::seconds(3), "brief"), 0U);
  EXPECT_THAT(told_, HasSubstr("the keys expired on"));
  ExpectFleetAtWork();
}

TEST_F(StrangersTest, AMemberInTheWrongRoleIsStoppedByItsOwnDds) {
  const auto stranger = Join(follower_keys_, exchange::ScoutTopics());
  ASSERT_FALSE(stranger);
  EXPECT_THAT(stranger.error().message, HasSubstr("trailcast/routes"));
}

// The member's DDS does not look at its own permissions, by a governance that demands none. The
// authority itself signs it here, which no thief could.
TEST_F(StrangersTest, AMemberInTheWrongRoleIsStoppedByTheOthersDds) {
  const auto server = SecuredServer();
  ASSERT_EQ(Teach(scout_keys_).status, 0);
  std::string lax = security::GovernanceXml();
  for (const char* control : {"enable_read_access_control", "enable_write_access_control"}) {
    const std::string demanded = "<" + std::string(control) + ">true";
    lax.replace(lax.find(demanded), demanded.size(), "<" + std::string(control) + ">false");
  }
  const auto key = security::ReadSmallFile(authority_.folder() / "authority.key").value();
  const auto certificate = security::ReadSmallFile(authority_.folder() / "authority.pem").value();
  const auto signed_lax = security::Sign(lax, {certificate, key}).value();
  ASSERT_TRUE(ReplaceFile(fs::path(observer_keys_) / "governance.p7s", signed_lax));
  const auto stranger = Join(observer_keys_, exchange::OperatorTopics());
  ASSERT_TRUE(stranger) << stranger.error().message;
  EXPECT_EQ(Stranger::HeardBy(**stranger, std::chrono::seconds(5)), 0U);
  EXPECT_TRUE(server->WaitForOutput("kept out")) << server->output();
  EXPECT_THAT(server->output(), HasSubstr("does not follow the fleet's governance"));
  ExpectFleetAtWork();
}

TEST_F(StrangersTest, AnOldPermissionsFileWithLargerRightsFitsNoKeys) {
  fs::copy(operator_keys_, folder_ / "was_operator");
  ASSERT_TRUE(authority_.Renew("desk", Role::kObserver, Now(), 30));
  const auto server = SecuredServer();
  ASSERT_EQ(Teach(scout_keys_).status, 0);
  // The new identity with the old permissions:
  fs::copy_file(folder_ / "was_operator" / "permissions.p7s",
                fs::path(operator_keys_) / "permissions.p7s", fs::copy_options::overwrite_existing);
  const auto mixed = Join(operator_keys_, exchange::OperatorTopics());
  ASSERT_FALSE(mixed);
  EXPECT_THAT(mixed.error().message, HasSubstr("Subject name is invalid"));
  // The whole old folder, which does not know that it was revoked:
  const auto stranger = Join(Path("was_operator"), exchange::OperatorTopics());
  ASSERT_TRUE(stranger) << stranger.error().message;
  EXPECT_EQ(Stranger::HeardBy(**stranger, kStay), 0U);
  ExpectKeptOutOnce(*server, "kept out");
  ExpectFleetAtWork();
}

TEST_F(StrangersTest, AMemberThatSpeaksForAnotherIsNotBelieved) {
  const auto server = SecuredServer();
  ASSERT_EQ(Teach(scout_keys_).status, 0);
  const auto stranger = Join(operator_keys_, exchange::OperatorTopics());
  ASSERT_TRUE(stranger) << stranger.error().message;
  EXPECT_GT(Stranger::HeardBy(**stranger, std::chrono::seconds(5)),
            0U);  // announcements, as it may
  ExpectKeptOutOnce(*server, "speaks in the name of 'stranger'");
  ExpectFleetAtWork();
}

TEST_F(StrangersTest, AScoutThatDeletesARouteIsNotBelieved) {
  const auto server = SecuredServer();
  ASSERT_EQ(Teach(scout_keys_).status, 0);
  const auto stranger = Join(scout_keys_, exchange::ScoutTopics());
  ASSERT_TRUE(stranger) << stranger.error().message;
  exchange::RouteAnnouncement deleted{.holder = AgentId("robot1"), .info = Taught()};
  deleted.info.standing = route::Standing::kDeleted;
  deleted.info.edition = 99;
  PublishUntil(**stranger, deleted, *server, "kept out");
  ExpectKeptOutOnce(*server, "announces labels");
  ExpectFleetAtWork();
}

TEST_F(StrangersTest, AFollowerThatMakesUpSegmentsIsNotBelieved) {
  const auto server = SecuredServer();
  ASSERT_EQ(Teach(scout_keys_).status, 0);
  const auto stranger = Join(follower_keys_, exchange::FollowerTopics());
  ASSERT_TRUE(stranger) << stranger.error().message;
  const exchange::SegmentBatch made_up{.sender = AgentId("robot2"),
                                       .pieces = {PieceOf(Taught().key, 100)}};
  PublishUntil(**stranger, made_up, *server, "robot2 lends segment 100");
  EXPECT_THAT(server->output(), HasSubstr("not taken"));
  ExpectFleetAtWork();
}

}  // namespace
}  // namespace trailcast::test
