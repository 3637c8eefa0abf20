#include "services/records/mission_store.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "tests/support/temp_dir.h"

namespace trailcast::store {
namespace {

using mission::Mission;
using mission::Report;
using mission::State;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class MissionStoreTest : public testing::Test {
 protected:
  void SetUp() override { Reopen(); }
  void Reopen() {
    store_.reset();
    auto opened = MissionStore::Open(folder_ / "missions");
    ASSERT_TRUE(opened) << opened.error().message;
    store_ = std::move(*opened);
  }
  static Mission For(const std::string& robot, const std::string& id,
                     const std::string& orders = "follow hall") {
    return {.agent = AgentId(robot),
            .id = id,
            .client = AgentId("desk-p7"),
            .orders = orders,
            .valid_for_s = 600,
            .goes_on = true};
  }
  Result<mission::Record> Stored(const Mission& mission) {
    return store_->Add({&mission, 1}, ++now_ms_).front();
  }
  void Add(const Mission& mission) {
    const auto added = Stored(mission);
    ASSERT_TRUE(added) << added.error().message;
  }
  bool Change(const std::string& robot, const std::string& id, std::uint32_t change, State state) {
    const Report report{.agent = AgentId(robot),
                        .mission = id,
                        .change = change,
                        .state = state,
                        .task = 2,
                        .way = 3,
                        .waits_for = mission::WaitsFor::kPlace,
                        .detail = "why"};
    const auto news = store_->Change({&report, 1}, ++now_ms_);
    EXPECT_TRUE(news);
    return news && news->front();
  }
  std::vector<std::string> Found(const mission::Query& query) {
    const auto page = store_->Find(query);
    EXPECT_TRUE(page);
    std::vector<std::string> ids;
    for (const mission::Record& record : page->missions) ids.push_back(record.mission.id);
    return ids;
  }

  test::TempDir folder_;
  std::int64_t now_ms_ = 1000;
  std::unique_ptr<MissionStore> store_;
};

TEST_F(MissionStoreTest, KeepsAMissionAndWhatBecameOfItOverARestart) {
  Add(For("robot1", "m1"));
  EXPECT_TRUE(Change("robot1", "m1", 1, State::kAccepted));
  Reopen();
  const auto page = store_->Find({});
  ASSERT_TRUE(page);
  ASSERT_EQ(page->missions.size(), 1U);
  const mission::Record& record = page->missions[0];
  EXPECT_EQ(record.mission, For("robot1", "m1"));
  EXPECT_EQ(record.last.state, State::kAccepted);
  EXPECT_EQ(record.last.task, 2U);
  EXPECT_EQ(record.last.way, 3U);
  EXPECT_EQ(record.last.waits_for, mission::WaitsFor::kPlace);
  EXPECT_EQ(record.last.detail, "why");
  EXPECT_EQ(record.sent_unix_ms, 1001);
  EXPECT_EQ(record.changed_unix_ms, 1002);
}

TEST_F(MissionStoreTest, OneThatIsThereStaysAsItIs) {
  Add(For("robot1", "m1"));
  const auto again = Stored(For("robot1", "m1", "follow yard"));
  ASSERT_TRUE(again);
  EXPECT_EQ(again->mission.orders, "follow hall");
  Add(For("robot2", "m1", "follow yard"));
  EXPECT_THAT(Found({}), ElementsAre("m1", "m1"));
}

TEST_F(MissionStoreTest, OnlyNewsChangesIt) {
  Add(For("robot1", "m1"));
  EXPECT_TRUE(Change("robot1", "m1", 2, State::kUnderWay));
  EXPECT_FALSE(Change("robot1", "m1", 1, State::kAccepted)) << "late on its way";
  EXPECT_FALSE(Change("robot1", "m1", 2, State::kUnderWay)) << "once more";
  EXPECT_FALSE(Change("robot1", "m1", 0, State::kExpired)) << "a server's word is the last";
  EXPECT_FALSE(Change("robot1", "m7", 1, State::kAccepted)) << "nobody's";
}

TEST_F(MissionStoreTest, TheRobotsWordIsNewerThanAServers) {
  Add(For("robot1", "m1"));
  EXPECT_TRUE(Change("robot1", "m1", 0, State::kExpired));
  EXPECT_FALSE(Change("robot1", "m1", 0, State::kCancelled)) << "it has expired";
  EXPECT_TRUE(Change("robot1", "m1", 1, State::kAccepted)) << "it had it all the while";
}

TEST_F(MissionStoreTest, TellsWhichNobodyHasAnswered) {
  for (const char* id : {"m1", "m2", "m3"}) Add(For("robot1", id));
  (void)Change("robot1", "m2", 1, State::kAccepted);
  const auto unanswered = store_->Unanswered();
  ASSERT_TRUE(unanswered);
  ASSERT_EQ(unanswered->size(), 2U);
  EXPECT_EQ((*unanswered)[0].mission.id, "m1");
  EXPECT_EQ((*unanswered)[1].mission.id, "m3");
}

TEST_F(MissionStoreTest, FindsByWhateverIsAskedFor) {
  Add(For("robot1", "m1", "follow hall wait 5 follow yard"));
  Add(For("robot2", "m2", "follow yard"));
  Add(For("robot1", "m3", "wait 5"));
  (void)Change("robot2", "m2", 1, State::kFailed);
  EXPECT_THAT(Found({}), ElementsAre("m3", "m2", "m1"));
  EXPECT_THAT(Found({.agent = "robot1"}), ElementsAre("m3", "m1"));
  EXPECT_THAT(Found({.route = "yard"}), ElementsAre("m2", "m1"));
  EXPECT_THAT(Found({.route = "hal"}), IsEmpty());
  EXPECT_THAT(Found({.id = "m2"}), ElementsAre("m2"));
  EXPECT_THAT(Found({.client = "desk"}), ElementsAre("m3", "m2", "m1")) << "whichever process";
  EXPECT_THAT(Found({.client = "des"}), IsEmpty());
  EXPECT_THAT(Found({.states = 1U << 0U}), ElementsAre("m3", "m1"));
  EXPECT_THAT(Found({.states = 1U << static_cast<unsigned>(State::kFailed)}), ElementsAre("m2"));
  EXPECT_THAT(Found({.from_unix_ms = 1002, .until_unix_ms = 1003}), ElementsAre("m2"));
}

TEST_F(MissionStoreTest, OfWhomIsAskedForAreAllProcessesAndNobodyWhoseNameOnlyBeginsAlike) {
  const std::vector<std::string> clients{"desk", "desk-p7", "desk-pump", "desk-p7x", "desk-p"};
  std::uint64_t number = 0;
  for (const std::string& client : clients) {
    Mission mission = For("robot1", "of-" + client);
    mission.client = AgentId(client);
    Add(mission);
    ASSERT_TRUE(store_->Add(
        mission::NowCommand{.client = AgentId(client), .number = ++number, .reason = client},
        ++now_ms_));
  }
  EXPECT_THAT(Found({.client = "desk"}), ElementsAre("of-desk-p7", "of-desk"));
  EXPECT_THAT(Found({.client = "desk-p7"}), ElementsAre("of-desk-p7"));
  EXPECT_THAT(Found({.client = "desk-pump"}), ElementsAre("of-desk-pump"));
  const auto commands = store_->FindCommands({.client = "desk"});
  ASSERT_TRUE(commands) << commands.error().message;
  std::vector<std::string> given_by;
  for (const mission::GivenCommand& given : commands->commands) {
    given_by.push_back(given.command.client.value());
  }
  EXPECT_THAT(given_by, ElementsAre("desk-p7", "desk"));
}

TEST_F(MissionStoreTest, OfThoseThatComeTogetherEachIsAnsweredForItself) {
  std::vector<Mission> missions;
  for (int i = 0; i <= MissionStore::kMostUnansweredOfClient; ++i) {
    missions.push_back(For("robot1", "m" + std::to_string(i)));
  }
  missions.push_back(For("robot1", "m7", "follow yard"));
  missions.push_back(For("robot1", "of-another"));
  missions.back().client = AgentId("lab");
  const auto stored = store_->Add(missions, ++now_ms_);
  ASSERT_EQ(stored.size(), missions.size());
  EXPECT_TRUE(stored[MissionStore::kMostUnansweredOfClient - 1]);
  EXPECT_FALSE(stored[MissionStore::kMostUnansweredOfClient]) << "one too many of its sender";
  ASSERT_TRUE(stored[MissionStore::kMostUnansweredOfClient + 1]);
  EXPECT_EQ(stored[MissionStore::kMostUnansweredOfClient + 1]->mission.orders, "follow hall");
  EXPECT_TRUE(stored.back());
  Reopen();
  EXPECT_EQ(store_->Unanswered()->size(), MissionStore::kMostUnansweredOfClient + 1U);
}

TEST_F(MissionStoreTest, GivesPagesOneAfterTheOther) {
  for (int i = 0; i < 5; ++i) Add(For("robot1", "m" + std::to_string(i)));
  mission::Query query{.page_size = 2};
  std::vector<std::string> all;
  do {
    const auto page = store_->Find(query);
    ASSERT_TRUE(page);
    ASSERT_LE(page->missions.size(), 2U);
    for (const auto& record : page->missions) all.push_back(record.mission.id);
    query.before = page->next;
  } while (query.before != 0);
  EXPECT_THAT(all, ElementsAre("m4", "m3", "m2", "m1", "m0"));
}

TEST_F(MissionStoreTest, KeepsCommandsWithTheirAnswers) {
  const mission::NowCommand stop{.client = AgentId("desk-p7"),
                                 .number = 0xFFFFFFFFFFFFFFFF,
                                 .order = mission::NowOrder::kStop,
                                 .whom = mission::NowWhom::kRobot,
                                 .name = "robot1",
                                 .reason = "smoke"};
  const mission::NowCommand pause{.client = AgentId("lab-p7"),
                                  .number = 5,
                                  .order = mission::NowOrder::kPause,
                                  .whom = mission::NowWhom::kOnRoute,
                                  .name = "hall"};
  const mission::NowAnswer refused{.agent = AgentId("robot2"),
                                   .client = pause.client,
                                   .number = pause.number,
                                   .refused = true,
                                   .detail = "why"};
  ASSERT_TRUE(store_->Add(stop, 1000));
  ASSERT_TRUE(store_->Add(pause, 2000));
  ASSERT_TRUE(store_->Add(pause, 3000)) << "said again";
  ASSERT_TRUE(store_->Add(refused));
  ASSERT_TRUE(store_->Add(
      mission::NowAnswer{.agent = AgentId("robot2"), .client = AgentId("nobody"), .number = 1}));
  Reopen();
  const auto found = [&](const mission::Query& query) {
    const auto page = store_->FindCommands(query);
    EXPECT_TRUE(page);
    return page->commands;
  };
  const mission::GivenCommand first{stop, {}, 1000};
  const mission::GivenCommand second{pause, {refused}, 2000};
  EXPECT_THAT(found({}), ElementsAre(second, first));
  EXPECT_THAT(found({.agent = "robot1"}), ElementsAre(first));
  EXPECT_THAT(found({.agent = "robot2"}), ElementsAre(second)) << "it answered";
  EXPECT_THAT(found({.route = "hall"}), ElementsAre(second));
  EXPECT_THAT(found({.client = "desk"}), ElementsAre(first));
  EXPECT_THAT(found({.from_unix_ms = 1500}), ElementsAre(second));
  const auto page = store_->FindCommands({.page_size = 1});
  ASSERT_TRUE(page);
  EXPECT_THAT(found({.before = page->next}), ElementsAre(first));
}

TEST_F(MissionStoreTest, ForgetsTheOldestThatHaveEnded) {
  store_.reset();
  store_ = *MissionStore::Open(folder_ / "missions", 3);
  Add(For("robot1", "waits"));
  for (int i = 0; i < 6; ++i) {
    const std::string id = "m" + std::to_string(i);
    Add(For("robot1", id));
    (void)Change("robot1", id, 1, State::kArrived);
    ASSERT_TRUE(store_->Add(
        mission::NowCommand{.client = AgentId("desk"), .number = static_cast<std::uint64_t>(i) + 1},
        now_ms_));
  }
  Add(For("robot1", "last"));
  EXPECT_THAT(Found({}), ElementsAre("last", "m5", "m4", "waits"));
  const auto page = store_->FindCommands({});
  ASSERT_TRUE(page);
  EXPECT_EQ(page->commands.size(), 3U);
}

TEST_F(MissionStoreTest, NobodyShutsOutTheOthers) {
  for (int i = 0; i < MissionStore::kMostUnansweredOfClient; ++i) {
    Mission mission = For("robot1", "m" + std::to_string(i));
    mission.client = AgentId("desk-p" + std::to_string(i));  // a process each
    Add(mission);
  }
  const auto more = Stored(For("robot1", "more"));
  ASSERT_FALSE(more);
  EXPECT_THAT(more.error().message, HasSubstr("missions of 'desk-p7' wait"));
  Mission of_another = For("robot1", "other");
  for (const char* other : {"hall-p7", "desk-pump", "desk-p7x", "de"}) {
    of_another.client = AgentId(other);
    of_another.id = other;
    Add(of_another);
  }
  EXPECT_TRUE(Change("robot1", "m0", 1, State::kAccepted));
  Add(For("robot1", "more"));
}

TEST_F(MissionStoreTest, WhoseNameOnlyBeginsAlikeIsAnotherSender) {
  for (int i = 0; i < MissionStore::kMostUnansweredOfClient; ++i) {
    Mission mission = For("robot1", "m" + std::to_string(i));
    mission.client = AgentId("desk-pump");
    Add(mission);
  }
  Mission mission = For("robot1", "other");
  mission.client = AgentId("desk");
  Add(mission);
}

TEST_F(MissionStoreTest, ForgetsInRunsThatAreShortToo) {
  for (int run = 0; run < 60; ++run) {
    store_.reset();
    store_ = *MissionStore::Open(folder_ / "missions", 50);
    const std::string id = "m" + std::to_string(run);
    Add(For("robot1", id));
    (void)Change("robot1", id, 1, State::kArrived);
  }
  EXPECT_LE(Found({.page_size = 100}).size(), 51U);
}

TEST_F(MissionStoreTest, KeepsWhichQueuesAreHeldAndWhyOverARestart) {
  using Hold = MissionStore::Hold;
  ASSERT_TRUE(store_->Put(Hold{AgentId("robot1"), "stopped", 1000}));
  ASSERT_TRUE(store_->Put(Hold{AgentId("robot2"), "stopped", 1000}));
  ASSERT_TRUE(store_->Put(Hold{AgentId("robot1"), "", 2000}));
  ASSERT_TRUE(store_->ForgetHold(AgentId("robot2")));
  ASSERT_TRUE(store_->ForgetHold(AgentId("robot3")));
  ASSERT_TRUE(store_->Put(Hold{AgentId("robot4"), "sent home", 3000, true}));
  ASSERT_TRUE(store_->Put(Hold{AgentId("robot5"), "sent home", 3000, true}));
  ASSERT_TRUE(store_->Put(Hold{AgentId("robot5"), "stopped", 4000}));
  Reopen();
  const auto holds = store_->Holds();
  ASSERT_TRUE(holds) << holds.error().message;
  EXPECT_THAT(*holds, ElementsAre(Hold{AgentId("robot1"), "", 2000},
                                  Hold{AgentId("robot4"), "sent home", 3000, true},
                                  Hold{AgentId("robot5"), "stopped", 4000}));
}

TEST_F(MissionStoreTest, KeepsSchedulesAndWhatTheyHaveSentOverARestart) {
  using Schedule = MissionStore::Schedule;
  Schedule kept{
      .name = "round",
      .words = "round to robot1 ..",
      .by = "desk",
      .paused_by = "boss",
      .looked_unix_ms = 2000,
      .last_unix_ms = 1000,
      .outcome = "hall is closed",
      .sent = {{AgentId("robot1"), "round-1", ""}, {AgentId("robot2"), "", "its battery"}}};
  ASSERT_TRUE(store_->Put(kept));
  ASSERT_TRUE(store_->Put(Schedule{.name = "gone", .sent = kept.sent}));
  ASSERT_TRUE(store_->ForgetSchedule("gone"));
  ASSERT_TRUE(store_->ForgetSchedule("never"));
  kept.sent.pop_back();
  kept.paused_by.clear();
  ASSERT_TRUE(store_->Put(kept));
  ASSERT_TRUE(store_->Put(Schedule{.name = "another"}));
  Reopen();
  const auto schedules = store_->Schedules();
  ASSERT_TRUE(schedules) << schedules.error().message;
  EXPECT_THAT(*schedules, ElementsAre(Schedule{.name = "another"}, kept));
}

TEST_F(MissionStoreTest, GetsOneMission) {
  Add(For("robot1", "m1"));
  const auto found = store_->Get(AgentId("robot1"), "m1");
  ASSERT_TRUE(found && *found);
  EXPECT_EQ((*found)->mission, For("robot1", "m1"));
  EXPECT_EQ(store_->Get(AgentId("robot2"), "m1").value(), std::nullopt);
}

// The file is as an earlier program has left it.
TEST_F(MissionStoreTest, AFileWithoutHeldQueuesAndSchedulesIsGivenThem) {
  Add(For("robot1", "m1"));
  store_.reset();
  SQLite::Database((folder_ / "missions").string(), SQLite::OPEN_READWRITE)
      .exec("DROP TABLE queue_hold; DROP TABLE schedule; DROP TABLE schedule_sent");
  Reopen();
  EXPECT_TRUE(store_->Put(MissionStore::Hold{AgentId("robot1"), "stopped", 1000}));
  EXPECT_TRUE(store_->Put(MissionStore::Schedule{.name = "round"}));
  EXPECT_THAT(Found({}), ElementsAre("m1"));
}

TEST_F(MissionStoreTest, IsOneProcessAlone) {
  const auto other = MissionStore::Open(folder_ / "missions");
  ASSERT_FALSE(other);
  EXPECT_EQ(other.error().code, ErrorCode::kConflict);
}

TEST_F(MissionStoreTest, ThatIsSomethingElseIsRefusedAndLeftAlone) {
  std::ofstream(folder_ / "text")
      << "no database at all, but long enough to be taken for one, it is";
  const auto text = MissionStore::Open(folder_ / "text");
  ASSERT_FALSE(text);
  EXPECT_EQ(text.error().code, ErrorCode::kCorrupt);
  EXPECT_THAT(text.error().message, HasSubstr("mission store"));
  const auto nowhere = MissionStore::Open(folder_ / "nowhere" / "missions");
  ASSERT_FALSE(nowhere);
  EXPECT_EQ(nowhere.error().code, ErrorCode::kUnavailable);
}

}  // namespace
}  // namespace trailcast::store
