// The network of routes over HTTP, and what was changed of it, from a server's parts in this
// process.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <nlohmann/json.hpp>
#include <thread>

#include "route_server/network/network_registry.h"
#include "route_server/routes/history.h"
#include "services/base/unix_time.h"
#include "services/console/web.h"
#include "services/exchange/in_process_exchange.h"
#include "services/fleet/routes/route_export.h"
#include "tests/support/memory_store.h"
#include "tests/support/temp_dir.h"
#include "tests/unit/console/replied.h"

namespace trailcast::console {
namespace {

using nlohmann::json;
using std::chrono::milliseconds;
using testing::HasSubstr;

class NetworkApiTest : public testing::Test {
 protected:
  // hall of 20 m, office of 10 m.
  void Serve() {
    Put(1, "hall", 20.0);
    Put(2, "office", 10.0);
    registry_ = server::NetworkRegistry::Open(
                    AgentId("barn"), store::NetworkStore::Open(folder_ / "joints").value(), routes_)
                    .value();
    history_ = server::History::Open(AgentId("barn"),
                                     store::HistoryStore::Open(folder_ / "history").value(),
                                     routes_, kBegan_unix_ms)
                   .value();
    server_ = std::jthread([this](const std::stop_token& stop) {
      const auto exchange = bus_.Open(exchange::ServerTopics());
      while (!stop.stop_requested()) {
        for (const exchange::Message& message : exchange->Take(milliseconds(5))) {
          if (const auto* asked = std::get_if<exchange::NetworkRequest>(&message)) {
            if (asked->words.empty()) ++listed_;
            const auto since = network::ParseChangesSince(asked->words);
            (void)exchange->Publish(since ? history_->Answer(*asked, *since, kBegan_unix_ms)
                                          : registry_->Answer(*asked));
          } else if (const auto* edit = std::get_if<exchange::NetworkEdit>(&message)) {
            (void)exchange->Publish(registry_->Change(*edit, NowUnixMs()));
            (void)history_->Add(registry_->TakeMade());
          }
        }
      }
    });
  }
  void Put(unsigned number, const std::string& name, double length_m) {
    const route::RouteKey key = test::KeyNumber(number, 1);
    route::RouteInfo info = test::InfoOf(key, test::PiecesOf(key, 2), route::RouteState::kComplete);
    info.name = name;
    info.length_m = length_m;
    info.standing = route::Standing::kActive;
    ASSERT_TRUE(routes_.PutRoute(info));
  }

  [[nodiscard]] httplib::Client Client() const {
    return ClientOf(web_->port(), std::chrono::seconds(60));
  }
  [[nodiscard]] Replied Get(const std::string& path) const { return ReplyOf(Client().Get(path)); }
  [[nodiscard]] Replied Edit(const std::string& words) const {
    return ReplyOf(
        Client().Post("/api/network/edits", json{{"words", words}}.dump(), "application/json"));
  }

  static constexpr std::int64_t kBegan_unix_ms = 1000;
  test::TempDir folder_;
  test::MemoryStore routes_;
  std::unique_ptr<server::NetworkRegistry> registry_;
  std::unique_ptr<server::History> history_;
  exchange::InProcessBus bus_;
  std::atomic<int> listed_{0};
  std::jthread server_;
  Desk desk_{AgentId("desk-p7"), bus_.Open(ConsoleTopics()),
             Desk::Options{.reply_within = milliseconds(20'000)}};
  Atlas atlas_{[this]() -> Result<fleet::OperatorPeer> {
    return fleet::OperatorPeer{AgentId("desk-map"), bus_.Open(fleet::ExporterTopics())};
  }};
  std::unique_ptr<Web> web_ = Web::Open(desk_, atlas_, nullptr, "localhost", 0, {}).value();
};

TEST_F(NetworkApiTest, WhatIsChangedIsSeenAtOnceWithOnesOwnEyes) {
  Serve();
  EXPECT_EQ(Get("/api/network").body["routes"], 0);
  const Replied joined = Edit("join hall@12.0 office@0 both");
  ASSERT_EQ(joined.status, 200) << joined.body;
  EXPECT_EQ(joined.body["now"], json({"join hall@12 office@0 both"}));
  ASSERT_EQ(Edit("close hall 3..7").status, 200);
  ASSERT_EQ(Edit("name bay office@8").status, 200);
  const Replied listed = Get("/api/network");
  ASSERT_EQ(listed.status, 200) << listed.body;
  const json& network = listed.body["network"];
  ASSERT_EQ(network["routes"].size(), 2U) << listed.body;
  EXPECT_EQ(network["joints"][0]["both"], true);
  EXPECT_EQ(network["closed"][0]["from_m"], 3.0);
  EXPECT_EQ(network["names"][0]["name"], "bay");
  EXPECT_EQ(Get("/api/network?search=bay").body["network"]["routes"].size(), 1U);
  EXPECT_EQ(Edit("open hall").body["now"], json::array());
  EXPECT_EQ(Get("/api/network").body["network"]["closed"], json::array());
}

TEST_F(NetworkApiTest, AServerIsAskedOnceForAllWhoLook) {
  Serve();
  for (int i = 0; i < 20; ++i) ASSERT_EQ(Get("/api/network").status, 200);
  EXPECT_LT(listed_, 20);
  std::vector<std::jthread> lookers;
  std::atomic<int> answered{0};
  for (int i = 0; i < 8; ++i) {
    lookers.emplace_back([&] { answered += Get("/api/network").status == 200 ? 1 : 0; });
  }
  lookers.clear();
  EXPECT_EQ(answered, 8);
}

TEST_F(NetworkApiTest, AWayIsTheOrdersOfAMission) {
  Serve();
  ASSERT_EQ(Edit("join hall@12 office@0").status, 200);
  const Replied found = Get("/api/network/way?from=hall@2&to=office@8");
  ASSERT_EQ(found.status, 200) << found.body;
  EXPECT_EQ(found.body["way"]["length_m"], 18.0);
  EXPECT_EQ(found.body["way"]["stretches"].size(), 2U);
  EXPECT_EQ(found.body["orders"], "goto office@8 follow hall 2..12 follow office 0..8");
  const Replied there = Get("/api/network/way?from=hall@2&to=hall@2");
  EXPECT_EQ(there.body["orders"], "");
  const Replied none = Get("/api/network/way?from=office@2&to=hall@2");
  EXPECT_EQ(none.status, 409);
  EXPECT_THAT(none.error(), HasSubstr("server 'barn': no way leads from office@2 to hall@2"));
  EXPECT_THAT(Get("/api/network/way?from=robot1&to=hall@2").error(),
              HasSubstr("'robot1' has not said where on a route it stands"));
}

TEST_F(NetworkApiTest, WhatWasChangedIsToldOfAllRoutesOrOfOne) {
  Serve();
  for (const char* const words :
       {"join hall@12 office@0", "close hall 3..7", "close office 1..2"}) {
    ASSERT_EQ(Edit(words).status, 200) << words;
  }
  const Replied all = Get("/api/changes?since=1h&limit=2");
  ASSERT_EQ(all.status, 200) << all.body;
  EXPECT_NEAR(all.body["since_unix_ms"].get<double>(), static_cast<double>(NowUnixMs()) - 3.6e6,
              60e3);
  const json& history = all.body["history"];
  EXPECT_EQ(history["kept_since_unix_ms"], kBegan_unix_ms);
  EXPECT_EQ(history["total"], 3);
  ASSERT_EQ(history["changes"].size(), 2U) << all.body;
  EXPECT_EQ(history["changes"][0]["what"], "close office 1..2");
  EXPECT_EQ(history["changes"][0]["by"], "desk");
  EXPECT_EQ(history["changes"][1]["routes"], json({"hall"}));
  const Replied hall =
      Get("/api/changes?since=1h&route=hall&route=" + test::KeyNumber(1, 1).route.value());
  EXPECT_EQ(hall.body["history"]["total"], 2) << hall.body;
  EXPECT_EQ(Get("/api/changes?since=0s").body["history"]["total"], 0);
  for (const char* const wrong :
       {"/api/changes", "/api/changes?since=lately", "/api/changes?since=2999-01-01",
        "/api/changes?since=%ff", "/api/changes?since=1h&since=2h", "/api/changes?since=1h&limit=0",
        "/api/changes?since=1h&limit=5001", "/api/changes?since=1h&dance=1"}) {
    EXPECT_EQ(Get(wrong).status, 400) << wrong;
  }
  EXPECT_THAT(Get("/api/changes?since=lately").error(),
              HasSubstr("'since': 'lately': expected a day (monday, "));
}

TEST_F(NetworkApiTest, WhatIsNotUnderstoodOrRefusedIsSaid) {
  Serve();
  for (const char* wrong :
       {"/api/network?limit=0", "/api/network?limit=501", "/api/network?dance=1",
        "/api/network?search=a&around=b", "/api/network?search=a&of=b",
        "/api/network?of=a&around=b", "/api/network/way", "/api/network/way?from=hall@2",
        "/api/network/way?from=a%20b&to=hall@2", "/api/network/way?from=hall@x&to=hall@2",
        "/api/network/way?from=%ff&to=hall@2"}) {
    EXPECT_EQ(Get(wrong).status, 400) << wrong;
  }
  for (const char* wrong : {"", "dance", "close", "close hall 7..3", "name a@b hall@1",
                            "join hall@1", "close hall\n3..7"}) {
    EXPECT_EQ(Edit(wrong).status, 400) << wrong;
  }
  EXPECT_EQ(ReplyOf(Client().Post("/api/network/edits", "{}", "application/json")).status, 400);
  const Replied refused = Edit("close attic");
  EXPECT_EQ(refused.status, 409);
  EXPECT_THAT(refused.error(), HasSubstr("server 'barn': there is no route 'attic'"));
  EXPECT_THAT(Edit("confirm hall@1 office@1").error(), HasSubstr("is proposed"));
}

}  // namespace
}  // namespace trailcast::console
