// A server keeps schedules, and operators change them.
#include <sqlite3.h>

#include <chrono>

#include "services/base/unix_time.h"
#include "tests/scenario/programs.h"
#include "tests/support/await.h"

namespace trailcast::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class SchedulesTest : public ProgramsTest {
 protected:
  Ended Tool(const Words& words) {
    return End(*Start("trailcast", words, "tool" + std::to_string(++tools_)));
  }
  Ended Schedule(const Words& words) { return Tool(With({"schedule"}, words)); }
  Ended Add(const std::string& name, const Words& more) {
    return Schedule(With({"add", name, "follow", "hall", "--to", "robot1", "--unheard"}, more));
  }
  // A server that has been off for so long looked at its schedules then.
  void HasBeenOffFor(std::chrono::milliseconds time) {
    sqlite3* db = nullptr;
    ASSERT_EQ(sqlite3_open(Path("server.db.missions").c_str(), &db), SQLITE_OK);
    const std::string sql =
        "UPDATE schedule SET looked_unix_ms = " + std::to_string(NowUnixMs() - time.count());
    EXPECT_EQ(sqlite3_exec(db, sql.c_str(), nullptr, nullptr, nullptr), SQLITE_OK);
    EXPECT_EQ(sqlite3_changes(db), 2);
    sqlite3_close(db);
  }

  std::unique_ptr<Process> server_;
  int tools_ = 0;
};

TEST_F(SchedulesTest, AreKeptOverARestartAndSendWhatWasMissedAsTold) {
  server_ = Server();
  const Ended added = Add(
      "caught-up", {"--every", "1h", "--zone", "Asia/Tokyo", "--missed", "once", "--valid", "2h"});
  ASSERT_EQ(added.status, 0) << added.output;
  EXPECT_THAT(added.output, AllOf(HasSubstr("caught-up  every 60 zone Asia/Tokyo, robot1"),
                                  HasSubstr("next  "), HasSubstr(" JST")));
  ASSERT_EQ(Add("left-out", {"--every", "1h", "--zone", "UTC"}).status, 0);
  server_->Signal(SIGKILL);
  (void)End(*server_);
  HasBeenOffFor(std::chrono::hours(26));
  server_ = Server("server.db", "server2");
  ASSERT_TRUE(server_->WaitForOutput("schedule caught-up, due ")) << server_->output();
  ASSERT_TRUE(server_->WaitForOutput("schedule left-out, due ")) << server_->output();
  const Ended missions = Tool({"missions", "--robot", "robot1", "--json"});
  EXPECT_THAT(missions.output, HasSubstr("caught-up-20"));
  const Ended listed = Schedule({"list", "--json"});
  EXPECT_EQ(listed.status, 0) << listed.output;
  EXPECT_THAT(listed.output, AllOf(HasSubstr("\"outcome\": \"sent"), HasSubstr("missed: ")));
}

TEST_F(SchedulesTest, ArePausedResumedAndRemoved) {
  server_ = Server();
  ASSERT_EQ(Add("round", {"--at", "08:30,12:00", "--on", "mon-fri", "--zone", "UTC"}).status, 0);
  EXPECT_THAT(Schedule({"pause", "round"}).output, HasSubstr("paused by operator"));
  EXPECT_THAT(Schedule({"resume", "round"}).output, Not(HasSubstr("paused")));
  EXPECT_THAT(Schedule({"list"}).output,
              AllOf(HasSubstr("at 08:30,12:00 on mon-fri zone UTC"), HasSubstr(" UTC\n")));
  const Ended other = Add("round", {"--at", "09:30", "--zone", "UTC"});
  EXPECT_EQ(other.status, 1);
  EXPECT_THAT(other.output, HasSubstr("there is a schedule round already"));
  EXPECT_THAT(Schedule({"remove", "round"}).output, HasSubstr("schedule round is removed"));
  EXPECT_THAT(Schedule({"list"}).output, HasSubstr("there are no schedules"));
  const Ended gone = Schedule({"remove", "round"});
  EXPECT_EQ(gone.status, 1);
  EXPECT_THAT(gone.output, HasSubstr("no schedule is called 'round'"));
}

TEST_F(SchedulesTest, TakePhotosAsMissionsThatAreSentDo) {
  server_ = Server();
  const Words when{"--at", "08:30", "--zone", "UTC", "--photo-every", "5"};
  const Ended along = Add("along", With(when, {"--photo-at", "hall@3"}));
  EXPECT_EQ(along.status, 0) << along.output;
  EXPECT_THAT(along.output, HasSubstr("photo every 5 at hall@3 follow hall"));
  const Ended there =
      Schedule(With({"add", "there", "goto", "office@8", "--to", "robot1", "--unheard"}, when));
  EXPECT_EQ(there.status, 0) << there.output;
  EXPECT_THAT(there.output, HasSubstr("goto office@8 photo every 5"));
  const Ended nowhere = Add("nowhere", With(when, {"--photo-at", "dok"}));
  EXPECT_EQ(nowhere.status, 1) << nowhere.output;
  EXPECT_THAT(nowhere.output, HasSubstr("no place is called 'dok'"));
}

TEST_F(SchedulesTest, WhatCannotBeIsRefusedInWords) {
  const auto refused = [this](const Words& more) {
    const Ended ended = Add("round", more);
    EXPECT_EQ(ended.status, 2) << ended.output;
    return ended.output;
  };
  EXPECT_THAT(refused({"--at", "25:00", "--zone", "UTC"}), HasSubstr("'25:00'"));
  EXPECT_THAT(refused({"--at", "08:30", "--zone", "Europe/Hamburg"}),
              HasSubstr("there is no time zone 'Europe/Hamburg'"));
  EXPECT_THAT(refused({"--once", "2031-02-31T08:30", "--zone", "UTC"}),
              HasSubstr("2031-02-31 does not exist: February 2031 has 28 days"));
  EXPECT_THAT(refused({"--zone", "UTC"}), HasSubstr("expected one of 'at HH:MM'"));
  const Ended alone = Add("round", {"--at", "08:30", "--zone", "UTC", "--timeout", "0.5"});
  EXPECT_EQ(alone.status, 1);
  EXPECT_THAT(alone.output, HasSubstr("no route server answered"));
  server_ = Server();
  const Ended nobody = Schedule(
      {"add", "round", "follow", "hall", "--to", "robot1", "--at", "08:30", "--zone", "UTC"});
  EXPECT_EQ(nobody.status, 1) << nobody.output;
  EXPECT_THAT(nobody.output, AllOf(HasSubstr("robot1"), HasSubstr("--unheard")));
  const Ended past = Add("round", {"--once", "2020-01-01T08:30", "--zone", "UTC"});
  EXPECT_EQ(past.status, 1) << past.output;
  EXPECT_THAT(past.output, HasSubstr("is past"));
}

}  // namespace
}  // namespace trailcast::test
