#include "services/fleet/routes/catalog_client.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <thread>
#include <variant>

#include "services/exchange/in_process_exchange.h"

namespace trailcast::fleet {
namespace {

using std::chrono::milliseconds;
using ::testing::HasSubstr;
using ::testing::Not;

route::RouteInfo Aisle() {
  route::RouteInfo info;
  info.key = {RouteId("0123456789abcdef0123456789abcdef"), TeachingId(3)};
  info.revision = RevisionNumber(3);
  info.name = "aisle-3";
  info.scout = AgentId("scout");
  info.camera = "webcam 320x240";
  info.state = route::RouteState::kComplete;
  info.segment_count = 8;
  info.length_m = 16.0;
  info.bytes = 64000;
  info.taught_unix_ms = 1'000'000;
  return info;
}

// A server that lets the first `deaf_to` questions pass and answers each later one twice: first to
// somebody else, then to who asked.
class CatalogClientTest : public ::testing::Test {
 protected:
  void Serve(int deaf_to, exchange::CatalogReply reply) {
    server_ = std::jthread([this, deaf_to, reply](const std::stop_token& stop) mutable {
      const auto exchange = bus_.Open(exchange::ServerTopics());
      while (!stop.stop_requested()) {
        for (const exchange::Message& message : exchange->Take(milliseconds(20))) {
          const auto* request = std::get_if<exchange::CatalogRequest>(&message);
          if (request == nullptr || deaf_to-- > 0) continue;
          reply.server = AgentId("server");
          reply.request = request->request;
          reply.client = AgentId("another");
          ASSERT_TRUE(exchange->Publish(reply).has_value());
          reply.client = request->client;
          ASSERT_TRUE(exchange->Publish(reply).has_value());
        }
      }
    });
  }
  Result<exchange::CatalogReply> Ask(const std::string& name, milliseconds timeout) {
    const auto exchange = bus_.Open(exchange::OperatorTopics());
    return AskCatalog(*exchange, AgentId("operator"), {.name = name}, timeout);
  }

 private:
  exchange::InProcessBus bus_;
  std::jthread server_;
};

TEST_F(CatalogClientTest, TakesTheReplyThatIsMeantForIt) {
  exchange::CatalogReply reply;
  reply.page.routes = {Aisle()};
  Serve(0, reply);
  const auto answer = Ask("", milliseconds(20'000));
  ASSERT_TRUE(answer.has_value()) << answer.error().message;
  EXPECT_EQ(answer->client, AgentId("operator"));
  ASSERT_EQ(answer->page.routes.size(), 1U);
  EXPECT_EQ(answer->page.routes.front(), Aisle());
}

TEST_F(CatalogClientTest, AsksAgainWhenAQuestionWasNotHeard) {
  Serve(1, {});
  EXPECT_TRUE(Ask("", milliseconds(20'000)).has_value());
}

TEST_F(CatalogClientTest, SaysThatNoServerAnswered) {
  const auto answer = Ask("", milliseconds(150));
  ASSERT_FALSE(answer.has_value());
  EXPECT_EQ(answer.error().code, ErrorCode::kUnavailable);
  EXPECT_THAT(answer.error().message, HasSubstr("no route server answered within 0.1"));
}

TEST_F(CatalogClientTest, PassesOnWhatTheServerCouldNotDo) {
  exchange::CatalogReply reply;
  reply.error = "the disk is gone";
  Serve(0, reply);
  const auto answer = Ask("", milliseconds(20'000));
  ASSERT_FALSE(answer.has_value());
  EXPECT_THAT(answer.error().message, HasSubstr("the disk is gone"));
}

exchange::CatalogReply Reply(std::vector<route::RouteInfo> routes) {
  return {.page = {.routes = std::move(routes)}};
}

TEST(RoutesTable, SaysWhichAgentsHoldARevision) {
  exchange::CatalogReply reply = Reply({Aisle()});
  EXPECT_EQ(RoutesJson(reply)[0]["held_by"].dump(), "[]");
  reply.holdings = {{Aisle().key, AgentId("robot-1")}, {Aisle().key, AgentId("robot-2")}};
  EXPECT_THAT(RoutesTable(reply, 0), HasSubstr("robot-1, robot-2"));
  EXPECT_EQ(RoutesJson(reply)[0]["held_by"].dump(), R"(["robot-1","robot-2"])");
}

TEST(RoutesTable, SaysWhatIsServedInPart) {
  exchange::CatalogReply reply = Reply({Aisle()});
  EXPECT_THAT(RoutesTable(reply, 0), Not(HasSubstr("in part")));
  EXPECT_EQ(RoutesJson(reply)[0]["segments_lost"], 0);
  reply.lacking = {{Aisle().key, 3}};
  EXPECT_THAT(RoutesTable(reply, 0), HasSubstr("served in part: 3 of 8 segments are lost"));
  EXPECT_EQ(RoutesJson(reply)[0]["segments_lost"], 3);
}

TEST(RoutesTable, ShowsWhatARouteWeighsAMetre) {
  const std::string table = RoutesTable(Reply({Aisle()}), 1'000'000 + 300'000);
  EXPECT_THAT(table, HasSubstr("aisle-3"));
  EXPECT_THAT(table, HasSubstr("4000"));  // B/m
  EXPECT_THAT(table, HasSubstr("64.0"));  // kB
  EXPECT_THAT(table, HasSubstr("5 min"));
}

TEST(RoutesTable, ShowsShortIdsThatTellRoutesApartAndJsonTheWholeOnes) {
  route::RouteInfo other = Aisle();
  other.key.route = RouteId("0123456789abcdef0123456789abcdee");
  EXPECT_THAT(RoutesTable(Reply({Aisle()}), 0), HasSubstr("aisle-3  0123456@3  "));
  EXPECT_THAT(RoutesTable(Reply({Aisle(), other}), 0),
              HasSubstr("0123456789abcdef0123456789abcdee@3"));
  EXPECT_THAT(RoutesJson(Reply({Aisle()})).dump(),
              HasSubstr(R"("route":"0123456789abcdef0123456789abcdef","revision":3)"));
}

TEST(RoutesTable, TellsWhereARouteIsWeak) {
  const RouteStudy study{
      {{3.0, 4.5, view::Weakness::kBland, 7}, {9.0, 9.25, view::Weakness::kUnrelated, 2}}};
  const std::string text = WeakPlacesText(Aisle(), study);
  EXPECT_THAT(text, HasSubstr("'aisle-3' revision 3: weak where"));
  EXPECT_THAT(text, HasSubstr("3.0 to      4.5 m  little to recognise, 7 features"));
  EXPECT_THAT(text, HasSubstr("9.0 to      9.2 m  views in a row with 2 features in common"));
  EXPECT_THAT(WeakPlacesText(Aisle(), {}), HasSubstr("no weak place"));
  const auto json = RoutesJson(Reply({Aisle()}), {{Aisle().key, study}});
  EXPECT_EQ(json[0]["weak"][0].dump(), R"({"begin_m":3.0,"end_m":4.5,"why":"bland","features":7})");
  EXPECT_FALSE(RoutesJson(Reply({Aisle()}))[0].contains("weak"));
}

TEST(RoutesTable, TellsHowRoughAndSteepItsGroundIs) {
  const RouteStudy study{{},
                         {{0.0, 4.5, SegmentIndex(0), {0.0011, {}, {}}},
                          {4.5, 9.25, SegmentIndex(3), {0.02, 1.25, -0.07}},
                          {9.25, 10.0, SegmentIndex(5), {}}}};
  const std::string text = GroundText(Aisle(), study);
  EXPECT_THAT(text, HasSubstr("'aisle-3' revision 3: its ground\n"));
  EXPECT_THAT(text, HasSubstr("0.0 to      4.5 m  smooth (shakes by 0.11 % of the picture)\n"));
  EXPECT_THAT(text, HasSubstr("4.5 to      9.2 m  rough (1.25 m/s2), 4.0 degrees downhill\n"));
  EXPECT_THAT(text, HasSubstr("9.2 to     10.0 m  not known\n"));
  EXPECT_THAT(GroundText(Aisle(), {{}, {{0.0, 10.0, SegmentIndex(0), {}}}}),
              HasSubstr("of its ground nothing is known"));
  EXPECT_EQ(RoutesJson(Reply({Aisle()}), {{Aisle().key, study}})[0]["terrain"].dump(),
            R"([{"begin_m":0.0,"end_m":4.5,"roughness":"smooth","shake":0.0011},)"
            R"({"begin_m":4.5,"end_m":9.25,"roughness":"rough","shake":0.02,)"
            R"("vertical_mps2":1.25,"slope_deg":-4.0},{"begin_m":9.25,"end_m":10.0}])");
}

TEST(RoutesTable, SaysThatThereAreNone) { EXPECT_EQ(RoutesTable({}, 0), "no routes\n"); }

TEST(RoutesJson, HasWhatACameraMayBeCalledAndWhatARouteWeighsAMetre) {
  route::RouteInfo info = Aisle();
  info.camera = "8\" \\ lens\n";
  const auto json = RoutesJson(Reply({info, Aisle()}));
  ASSERT_EQ(json.size(), 2U);
  EXPECT_EQ(json[0]["camera"], info.camera);
  EXPECT_EQ(json[0]["bytes_per_m"], 4000.0);
}

}  // namespace
}  // namespace trailcast::fleet
