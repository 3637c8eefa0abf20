// Schedules over HTTP, from a server's part in this process.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <thread>

#include "route_server/fleet/schedule_registry.h"
#include "services/base/unix_time.h"
#include "services/console/web.h"
#include "services/exchange/bounds.h"
#include "services/exchange/in_process_exchange.h"
#include "services/fleet/routes/route_export.h"
#include "tests/support/temp_dir.h"
#include "tests/unit/console/replied.h"

namespace trailcast::console {
namespace {

using nlohmann::json;
using std::chrono::milliseconds;
using testing::HasSubstr;

class SchedulesApiTest : public testing::Test {
 protected:
  void Serve() {
    store_ = store::MissionStore::Open(folder_ / "missions").value();
    board_ =
        server::ScheduleRegistry::Open(AgentId("barn"), *store_,
                                       {.take = [](const auto&, auto, auto) {},
                                        .closed = [](const std::string&) { return std::string(); }})
            .value();
    server_ = std::jthread([this](const std::stop_token& stop) {
      const auto exchange = bus_.Open(exchange::ServerTopics());
      while (!stop.stop_requested()) {
        for (const exchange::Message& message : exchange->Take(milliseconds(5))) {
          if (const auto* asked = std::get_if<exchange::NetworkRequest>(&message)) {
            (void)exchange->Publish(asked->words.empty() ? NetworkFor(*asked)
                                                         : board_->Answer(*asked));
          } else if (const auto* edit = std::get_if<exchange::NetworkEdit>(&message)) {
            (void)exchange->Publish(board_->Change(*edit, NowUnixMs()));
          }
        }
      }
    });
  }
  static exchange::NetworkReply NetworkFor(const exchange::NetworkRequest& asked) {
    return {.server = AgentId("barn"),
            .client = asked.client,
            .request = asked.request,
            .lines = {"name dock hall@12"}};
  }
  [[nodiscard]] httplib::Client Client() const {
    return ClientOf(web_->port(), std::chrono::seconds(60));
  }
  [[nodiscard]] Replied List() const { return ReplyOf(Client().Get("/api/schedules")); }
  [[nodiscard]] Replied Add(const std::string& words) const {
    return ReplyOf(
        Client().Post("/api/schedules", json{{"words", words}}.dump(), "application/json"));
  }
  [[nodiscard]] Replied Tell(const std::string& name, const std::string& order) const {
    return ReplyOf(Client().Post("/api/schedules/" + name + "/" + order, "{}", "application/json"));
  }
  [[nodiscard]] Replied Remove(const std::string& name) const {
    return ReplyOf(Client().Delete("/api/schedules/" + name));
  }

  test::TempDir folder_;
  std::unique_ptr<store::MissionStore> store_;
  std::unique_ptr<server::ScheduleRegistry> board_;
  exchange::InProcessBus bus_;
  std::jthread server_;
  Desk desk_{AgentId("desk-p7"), bus_.Open(ConsoleTopics()),
             Desk::Options{.reply_within = milliseconds(20'000)}};
  Atlas atlas_{[this]() -> Result<fleet::OperatorPeer> {
    return fleet::OperatorPeer{AgentId("desk-map"), bus_.Open(fleet::ExporterTopics())};
  }};
  std::unique_ptr<Web> web_ = Web::Open(desk_, atlas_, nullptr, "localhost", 0, {}).value();
};

TEST_F(SchedulesApiTest, AreAddedListedPausedResumedAndRemoved) {
  Serve();
  EXPECT_EQ(List().body["schedules"], json::array());
  const std::string words =
      "round to robot1,cart-* at 08:30 on mon-fri zone Europe/Berlin battery 40 if-arrived do "
      "follow hall";
  const Replied added = Add(words);
  ASSERT_EQ(added.status, 200) << added.body;
  const json listed = List().body["schedules"];
  ASSERT_EQ(listed.size(), 1U);
  EXPECT_EQ(listed, added.body["schedules"]);
  const json& round = listed[0];
  EXPECT_EQ(round["name"], "round");
  EXPECT_EQ(round["server"], "barn");
  EXPECT_EQ(round["robots"], json({"robot1", "cart-*"}));
  EXPECT_EQ(round["when"], "at 08:30 on mon-fri zone Europe/Berlin");
  EXPECT_EQ(round["battery_percent"], 40);
  EXPECT_EQ(round["if_arrived"], true);
  EXPECT_EQ(round["by"], "desk");
  EXPECT_EQ(round["paused_by"], nullptr);
  EXPECT_THAT(round["next"]["text"].get<std::string>(), HasSubstr(" 08:30 CE"));
  EXPECT_EQ(round["last"], nullptr);
  EXPECT_EQ(round["words"], words);
  const Replied paused = Tell("round", "pause");
  ASSERT_EQ(paused.status, 200) << paused.body;
  EXPECT_EQ(paused.body["schedules"][0]["paused_by"], "desk");
  EXPECT_EQ(paused.body["schedules"][0]["next"], nullptr);
  EXPECT_EQ(Tell("round", "resume").body["schedules"][0]["paused_by"], nullptr);
  EXPECT_EQ(Remove("round").status, 200);
  EXPECT_EQ(List().body["schedules"], json::array());
}

TEST_F(SchedulesApiTest, AreChangedAndStayPaused) {
  Serve();
  ASSERT_EQ(Add("round to robot1 at 08:30 zone UTC do follow hall").status, 200);
  ASSERT_EQ(Tell("round", "pause").status, 200);
  const auto change = [&](const std::string& name, const std::string& words) {
    return ReplyOf(
        Client().Put("/api/schedules/" + name, json{{"words", words}}.dump(), "application/json"));
  };
  const Replied changed =
      change("round",
             "round to robot2 every 20 from 08:00 until 18:00 on sat,sun zone Asia/Tokyo "
             "do follow yard");
  ASSERT_EQ(changed.status, 200) << changed.body;
  const json round = List().body["schedules"][0];
  EXPECT_EQ(round["robots"], json({"robot2"}));
  EXPECT_EQ(round["paused_by"], "desk");
  EXPECT_EQ(round["times"], json::parse(R"({"at": [], "every_min": 20, "from": "08:00",
      "until": "18:00", "days": ["sat", "sun"], "once": null})"));
  EXPECT_EQ(change("round", "other to robot2 at 08:30 zone UTC do follow hall").status, 400);
  EXPECT_EQ(change("other", "other to robot2 at 08:30 zone UTC do follow hall").status, 409);
  EXPECT_EQ(change("round", "round to robot2 once 2020-01-01 08:30 zone UTC do follow hall").status,
            409);
}

TEST_F(SchedulesApiTest, TheCalendarHasWhatIsDueNextOfAll) {
  Serve();
  ASSERT_EQ(Add("late to robot1 at 20:00 on mon zone UTC do follow hall").status, 200);
  ASSERT_EQ(Add("early to robot1 at 08:30 on mon,tue zone UTC do follow hall").status, 200);
  ASSERT_EQ(Add("never to robot1 at 08:30 zone UTC do follow hall").status, 200);
  ASSERT_EQ(Tell("never", "pause").status, 200);
  const Replied calendar = ReplyOf(Client().Get("/api/schedules/calendar"));
  ASSERT_EQ(calendar.status, 200) << calendar.body;
  const json& firings = calendar.body["firings"];
  ASSERT_EQ(firings.size(), 12U) << "in four weeks";
  for (std::size_t i = 0; i < firings.size(); ++i) {
    EXPECT_NE(firings[i]["schedule"], "never");
    if (i > 0) {
      EXPECT_LT(firings[i - 1]["unix_ms"], firings[i]["unix_ms"]);
    }
  }
}

TEST_F(SchedulesApiTest, APreviewSaysWhenItWouldBeDueAndKeepsNothing) {
  Serve();
  const auto preview = [&](const std::string& words) {
    return ReplyOf(
        Client().Post("/api/schedules/preview", json{{"words", words}}.dump(), "application/json"));
  };
  const Replied good = preview("round to robot1 at 08:30 zone UTC valid 600 do follow hall");
  ASSERT_EQ(good.status, 200) << good.body;
  EXPECT_EQ(good.body["words"], "round to robot1 at 08:30 zone UTC do follow hall");
  EXPECT_EQ(good.body["firings"].size(), 10U);
  EXPECT_THAT(good.body["firings"][0]["text"].get<std::string>(), HasSubstr(" 08:30 UTC"));
  const Replied bad = preview("round to robot1 at 08:30 zone Mars do follow hall");
  EXPECT_EQ(bad.status, 400);
  EXPECT_THAT(bad.error(), HasSubstr("Mars"));
  EXPECT_EQ(List().body["schedules"], json::array());
}

TEST_F(SchedulesApiTest, TakePhotosAtPlacesThatAreLookedUp) {
  Serve();
  const auto with_photos = [&](const char* path, const char* orders, const json& at) {
    return ReplyOf(
        Client().Post(path,
                      json{{"words", std::string("round to robot1 at 08:30 zone UTC do ") + orders},
                           {"photo_every_m", 5},
                           {"photo_at", at}}
                          .dump(),
                      "application/json"));
  };
  const json places{"dock", "hall@3"};
  const Replied preview = with_photos("/api/schedules/preview", "goto office@8", places);
  ASSERT_EQ(preview.status, 200) << preview.body;
  EXPECT_EQ(preview.body["words"],
            "round to robot1 at 08:30 zone UTC do goto office@8 photo every 5 at dock=hall@12 at "
            "hall@3");
  const Replied added = with_photos("/api/schedules", "follow hall", places);
  ASSERT_EQ(added.status, 200) << added.body;
  EXPECT_EQ(List().body["schedules"][0]["orders"],
            "photo every 5 at dock=hall@12 at hall@3 follow hall");
  const Replied unknown = with_photos("/api/schedules/preview", "follow hall", {"dok"});
  EXPECT_EQ(unknown.status, 404);
  EXPECT_THAT(unknown.error(), HasSubstr("no place is called 'dok': there are dock"));
}

TEST_F(SchedulesApiTest, WhatCannotBeIsRefusedInWords) {
  Serve();
  const Replied wrong = Add("round to robot1 at 25:00 zone UTC do follow hall");
  EXPECT_EQ(wrong.status, 400);
  EXPECT_THAT(wrong.error(), HasSubstr("'25:00'"));
  EXPECT_EQ(ReplyOf(Client().Post("/api/schedules", "{}", "application/json")).status, 400);
  ASSERT_EQ(Add("round to robot1 at 08:30 zone UTC do follow hall").status, 200);
  const Replied taken = Add("round to robot1 at 09:30 zone UTC do follow hall");
  EXPECT_EQ(taken.status, 409);
  EXPECT_THAT(taken.error(), HasSubstr("there is a schedule round already"));
  const Replied none = Tell("other", "pause");
  EXPECT_EQ(none.status, 409);
  EXPECT_THAT(none.error(), HasSubstr("no schedule is called 'other': there are round"));
  EXPECT_EQ(Remove("other").status, 409);
  const std::string more = " wait 1";
  std::string words = "long to robot1 at 08:30 zone UTC do follow hall";
  while (words.size() + more.size() <= exchange::kMaxLineBytes) words += more;
  EXPECT_THAT(Add(words).error(), HasSubstr("too long by"));
}

}  // namespace
}  // namespace trailcast::console
