// Routes and what has been, over HTTP, from a server in this process.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <mutex>
#include <nlohmann/json.hpp>
#include <thread>

#include "services/catalog/catalog.h"
#include "services/catalog/editing.h"
#include "services/console/web.h"
#include "services/exchange/in_process_exchange.h"
#include "services/fleet/routes/route_export.h"
#include "services/image/files.h"
#include "services/store/route_store.h"
#include "tests/support/taught_route.h"
#include "tests/support/temp_dir.h"
#include "tests/support/walk_frames.h"
#include "tests/unit/console/replied.h"

namespace trailcast::console {
namespace {

using nlohmann::json;
using std::chrono::milliseconds;
using testing::HasSubstr;

class RoutesApiTest : public testing::Test {
 protected:
  // `count` routes of one revision each: aisle-0, aisle-1, ..
  void Hold(int count) {
    const route::RouteInfo taught = test::TeachSamples(1).info;
    for (int i = 0; i < count; ++i) {
      route::RouteInfo info = taught;
      info.key.route = RouteId(fmt::format("{:032x}", i + 1));
      info.name = fmt::format("aisle-{}", i);
      info.length_m = i;
      ASSERT_TRUE(store_->PutRoute(info));
    }
  }
  void Serve() {
    server_ = std::jthread([this](const std::stop_token& stop) {
      const auto exchange = bus_.Open(exchange::ServerTopics());
      while (!stop.stop_requested()) {
        for (const exchange::Message& message : exchange->Take(milliseconds(5))) {
          if (const auto* asked = std::get_if<exchange::CatalogRequest>(&message)) {
            (void)exchange->Publish(Answered(*asked));
          } else if (const auto* edit = std::get_if<exchange::RouteEditRequest>(&message)) {
            (void)exchange->Publish(Edited(*edit));
          } else if (const auto* history = std::get_if<exchange::MissionRequest>(&message)) {
            (void)exchange->Publish(Recalled(*history));
          }
        }
      }
    });
  }
  exchange::CatalogReply Answered(const exchange::CatalogRequest& request) {
    if (request.query.view.empty()) return catalog::Answer(request, AgentId("barn"), *store_);
    exchange::CatalogReply reply{AgentId("barn"), request.client, request.request, {}, {}, {}};
    route::RouteInfo hall = test::TeachSamples(3).info;
    reply.page.routes = {hall};
    reply.places = {{.key = hall.key, .segment = SegmentIndex(1), .score = 0.75}};
    return reply;
  }
  exchange::CatalogReply Edited(const exchange::RouteEditRequest& request) {
    exchange::CatalogReply reply{AgentId("barn"), request.client, request.request, {}, {}, {}};
    auto changed = catalog::PlanEdit(request.edit, *store_);
    if (!changed) {
      reply.error = changed.error().message;
      return reply;
    }
    EXPECT_TRUE(store_->PutRoutes(*changed));
    reply.page.routes = *changed;
    return reply;
  }
  exchange::MissionReply Recalled(const exchange::MissionRequest& request) {
    exchange::MissionReply reply{
        .server = AgentId("barn"), .client = request.client, .request = request.request, .next = 7};
    if (request.commands) {
      reply.commands.push_back({.command = {.client = AgentId("desk-p1"),
                                            .number = 1,
                                            .order = mission::NowOrder::kPause,
                                            .whom = mission::NowWhom::kAll,
                                            .reason = "rain"},
                                .answers = {{.agent = AgentId("robot1"),
                                             .client = AgentId("desk-p1"),
                                             .number = 1,
                                             .refused = true,
                                             .detail = "no"}},
                                .given_unix_ms = 5});
    } else {
      reply.missions.push_back(
          {.mission = {.agent = AgentId("robot1"),
                       .id = "trip",
                       .client = AgentId("desk-p1"),
                       .orders = "follow hall"},
           .last = {
               .agent = AgentId("robot1"), .mission = "trip", .state = mission::State::kArrived}});
    }
    const std::scoped_lock lock(mutex_);
    asked_ = request.query;
    return reply;
  }
  mission::Query Asked() {
    const std::scoped_lock lock(mutex_);
    return asked_;
  }

  [[nodiscard]] httplib::Client Client() const {
    return ClientOf(web_->port(), std::chrono::seconds(20));
  }
  [[nodiscard]] Replied Get(const std::string& path) const { return ReplyOf(Client().Get(path)); }
  [[nodiscard]] Replied Post(const std::string& path, const json& body) const {
    return ReplyOf(Client().Post(path, body.dump(), "application/json"));
  }

  test::TempDir folder_;
  std::unique_ptr<store::RouteStore> store_ = store::OpenSqliteStore(folder_ / "routes.db").value();
  exchange::InProcessBus bus_;
  std::mutex mutex_;
  mission::Query asked_;  // of the last question about missions or commands
  std::jthread server_;
  Desk desk_{AgentId("desk"), bus_.Open(ConsoleTopics()),
             Desk::Options{.answer_within = milliseconds(200), .reply_within = milliseconds(5000)}};
  Atlas atlas_{[this]() -> Result<fleet::OperatorPeer> {
    return fleet::OperatorPeer{AgentId("desk-map"), bus_.Open(fleet::ExporterTopics())};
  }};
  std::unique_ptr<Web> web_ = Web::Open(desk_, atlas_, nullptr, "localhost", 0, {}).value();
};

TEST_F(RoutesApiTest, PagesBringEveryRouteOnce) {
  Hold(120);
  Serve();
  std::set<std::string> names;
  std::string cursor;
  int pages = 0;
  do {
    const Replied page = ReplyOf(Client().Get(
        "/api/routes", httplib::Params{{"sort", "name"}, {"limit", "50"}, {"cursor", cursor}}, {}));
    ASSERT_EQ(page.status, 200) << page.body;
    EXPECT_EQ(page.body["total"], 120);
    for (const json& route : page.body["routes"]) {
      EXPECT_TRUE(names.insert(route["name"]).second) << route;
    }
    cursor = page.body["next"];
    ++pages;
  } while (!cursor.empty() && pages < 10);
  EXPECT_EQ(pages, 3);
  EXPECT_EQ(names.size(), 120U);
}

TEST_F(RoutesApiTest, ASearchIsAsTheCatalogHasIt) {
  Hold(12);
  Serve();
  EXPECT_EQ(Get("/api/routes?prefix=aisle-1").body["total"], 3);
  EXPECT_EQ(Get("/api/routes?tag=night&tag=east").body["total"], 12);
  EXPECT_EQ(Get("/api/routes?tag=night&tag=wet").body["total"], 0);
  EXPECT_EQ(Get("/api/routes?near_gps=48.25,11.5&within_m=10").body["total"], 12);
  EXPECT_EQ(Get("/api/routes?near_gps=49,11.5").body["total"], 0);
  EXPECT_EQ(Get("/api/routes?sort=longest&limit=1").body["routes"][0]["name"], "aisle-11");
  const Replied none = Get("/api/routes?name=aisle");
  EXPECT_THAT(none.body["similar"], testing::Contains("aisle-0"));
  const Replied wrong = Get("/api/routes?limit=201");
  EXPECT_EQ(wrong.status, 400);
  EXPECT_THAT(wrong.body["error"].get<std::string>(), HasSubstr("'limit'"));
}

TEST_F(RoutesApiTest, ARevisionIsActivatedRetiredAndRefusedWithTheReason) {
  Hold(1);
  Serve();
  const Replied activated = Post("/api/routes/aisle-0/edits", {{"action", "activate"}});
  ASSERT_EQ(activated.status, 200) << activated.body;
  EXPECT_EQ(activated.body["changed"][0]["state"], "active");
  EXPECT_EQ(Post("/api/routes/aisle-0/edits", {{"action", "activate"}}).body["changed"],
            json::array())
      << "it is so already";
  const Replied back = Post("/api/routes/aisle-0/edits", {{"action", "rollback"}});
  EXPECT_EQ(back.status, 409);
  EXPECT_THAT(back.body["error"].get<std::string>(), HasSubstr("server 'barn': "));
  EXPECT_EQ(Post("/api/routes/attic/edits", {{"action", "retire"}}).status, 409);
  const Replied retired =
      Post("/api/routes/aisle-0/edits", {{"action", "retire"}, {"revision", 2}});
  EXPECT_EQ(retired.body["changed"][0]["state"], "retired") << retired.body;
  EXPECT_EQ(Get("/api/routes?state=retired").body["total"], 1);
  for (const json& wrong :
       {json::object(), json{{"action", "delete"}}, json{{"action", "rollback"}, {"revision", 1}},
        json{{"action", "rename"}, {"text", "a/b"}}, json{{"action", "tag"}, {"tags", {1}}},
        json{{"action", "activate"}, {"revision", -1}}}) {
    EXPECT_EQ(Post("/api/routes/aisle-0/edits", wrong).status, 400) << wrong;
  }
}

TEST_F(RoutesApiTest, HistoryIsAskedForAsItIsFiltered) {
  Serve();
  const Replied missions =
      Get("/api/missions?robot=robot1&route=hall&state=arrived&state=under%20way&from_unix_ms=5&"
          "until_unix_ms=9&by=desk&limit=3&before=44");
  ASSERT_EQ(missions.status, 200) << missions.body;
  EXPECT_EQ(missions.body["missions"][0]["sent_by"], "desk");
  EXPECT_EQ(missions.body["next"], 7);
  const mission::Query asked = Asked();
  EXPECT_EQ(asked.agent, "robot1");
  EXPECT_EQ(asked.route, "hall");
  EXPECT_EQ(asked.states, 1U << 6U | 1U << 4U);
  EXPECT_EQ(asked.from_unix_ms, 5);
  EXPECT_EQ(asked.until_unix_ms, 9);
  EXPECT_EQ(asked.client, "desk");
  EXPECT_EQ(asked.page_size, 3U);
  EXPECT_EQ(asked.before, 44U);
  const Replied commands = Get("/api/commands?robot=robot1");
  ASSERT_EQ(commands.status, 200) << commands.body;
  EXPECT_EQ(commands.body["commands"][0]["whom"], "all robots");
  EXPECT_EQ(commands.body["commands"][0]["answers"][0]["obeys"], false);
  for (const char* wrong : {"missions?state=lost", "missions?before=x", "missions?dance=1",
                            "commands?state=arrived", "commands?limit=101"}) {
    EXPECT_EQ(Get(std::string("/api/") + wrong).status, 400) << wrong;
  }
}

TEST_F(RoutesApiTest, APictureTellsWhereItWasTaken) {
  Serve();
  const auto post = [&](const std::vector<std::uint8_t>& bytes, const char* type = "image/jpeg") {
    return ReplyOf(Client().Post("/api/where", std::string(bytes.begin(), bytes.end()), type));
  };
  const std::vector<std::uint8_t> picture =
      image::EncodeJpeg(test::WalkFrame(60, 640, 480), 95).value();
  ASSERT_GT(picture.size(), 64U << 10U) << "more than other requests may bring";
  const Replied found = post(picture);
  ASSERT_EQ(found.status, 200) << found.body;
  EXPECT_EQ(found.body["places"][0]["name"], "hall");
  EXPECT_EQ(found.body["places"][0]["segment"], 1);

  const image::GrayImage blank{160, 120, std::vector<std::uint8_t>(std::size_t{160} * 120, 90)};
  const Replied nothing = post(image::EncodeJpeg(blank, 95).value());
  EXPECT_EQ(nothing.status, 400);
  EXPECT_THAT(nothing.body["error"].get<std::string>(), HasSubstr("shows too little"));
  EXPECT_EQ(post({'G', 'I', 'F'}).status, 400);
  EXPECT_EQ(post({}).status, 400);
  std::vector<std::uint8_t> half = picture;
  half.resize(half.size() / 2);
  EXPECT_EQ(post(half).status, 422);
  const image::GrayImage vast{6001, 1000, std::vector<std::uint8_t>(std::size_t{6001} * 1000, 9)};
  EXPECT_EQ(post(image::EncodeJpeg(vast, 50).value()).status, 400);
  EXPECT_EQ(post(picture, "text/plain").status, 415);
}

}  // namespace
}  // namespace trailcast::console
