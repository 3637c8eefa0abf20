#include "services/fleet/reach.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace trailcast::fleet {
namespace {

using exchange::AgentRole;
using exchange::HeardAgent;
using exchange::ReachReport;
using std::chrono::milliseconds;
using std::chrono::seconds;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;

constexpr ReachSurvey::Time kStart{std::chrono::hours(1)};
const AgentId kDesk("desk");

HeardAgent Heard(const std::string& name, AgentRole role = AgentRole::kFollower) {
  return {.agent = AgentId(name),
          .role = role,
          .heard_for = seconds(720),
          .age = milliseconds(200),
          .late_ms = 0.6,
          .address = "10.0.0.7:41830",
          .network = "wlan0"};
}
HeardAgent HeardServer(const std::string& name = "server") {
  return Heard(name, AgentRole::kServer);
}

ReachReport AnswerOf(const std::string& name, std::vector<HeardAgent> heard, bool star = true) {
  return {.agent = AgentId(name),
          .client = kDesk,
          .request = 1,
          .role = AgentRole::kFollower,
          .star = star,
          .heard = std::move(heard)};
}
ReachReport ServersAnswer(std::vector<HeardAgent> heard, const std::string& name = "server") {
  ReachReport report = AnswerOf(name, std::move(heard), false);
  report.role = AgentRole::kServer;
  return report;
}

class ReachSurveyTest : public testing::Test {
 protected:
  Reach After(const std::vector<ReachReport>& reports, std::set<AgentId> expected = {}) {
    ReachSurvey survey(kDesk, std::move(expected));
    (void)survey.Ask(kStart);
    for (const ReachReport& report : reports) survey.Hear(report, kStart + milliseconds(8));
    return survey.Result(kStart + seconds(1));
  }
};

TEST_F(ReachSurveyTest, AllIsWellInAStarWhereServerAndRobotsHearEachOther) {
  HeardAgent robot1 = Heard("robot1");
  robot1.round_trip_ms = 1.24;
  const Reach reach =
      After({ServersAnswer({robot1, Heard("robot2")}), AnswerOf("robot1", {HeardServer()}),
             AnswerOf("robot2", {HeardServer()})},
            {AgentId("robot1")});
  EXPECT_TRUE(reach.complete());
  EXPECT_THAT(reach.troubles, IsEmpty());
  ASSERT_THAT(reach.members, SizeIs(3));
  ASSERT_THAT(reach.hearings, SizeIs(4));

  const std::string text = ReachText(reach);
  EXPECT_THAT(text, HasSubstr("robot1           follower  star      server             12 min    "
                              "0.2 s     1.2 ms     0.6 ms  10.0.0.7:41830 over wlan0\n"));
  EXPECT_THAT(text, HasSubstr("server           server    all       robot1             12 min    "
                              "0.2 s     1.2 ms"))
      << "there and back is as far as back and there";
  EXPECT_THAT(text, Not(HasSubstr("BAD")));

  const auto json = ReachJson(reach);
  EXPECT_EQ(json["all_hear_each_other"], true);
  EXPECT_THAT(json["troubles"], IsEmpty());
  EXPECT_EQ(json["members"][0]["name"], "robot1");
  EXPECT_EQ(json["members"][0]["discovery"], "star");
  const auto& heard = json["members"][0]["heard_by"][0];
  EXPECT_EQ(heard["by"], "server");
  EXPECT_EQ(heard["for_s"], 720.0);
  EXPECT_EQ(heard["last_s"], 0.2);
  EXPECT_EQ(heard["round_trip_ms"], 1.24);
  EXPECT_EQ(heard["address"], "10.0.0.7:41830");
  EXPECT_EQ(heard["network_interface"], "wlan0");
  EXPECT_EQ(json["members"][1]["heard_by"][0]["round_trip_ms"], nullptr);
}

TEST_F(ReachSurveyTest, OneWayIsToldWithWhatToDo) {
  const Reach reach = After({ServersAnswer({}), AnswerOf("robot1", {HeardServer()})});
  EXPECT_FALSE(reach.complete());
  ASSERT_THAT(reach.troubles, SizeIs(1));
  EXPECT_EQ(reach.troubles[0].member, AgentId("server"));
  EXPECT_EQ(reach.troubles[0].what, "server does not hear robot1, which hears it");
  EXPECT_THAT(reach.troubles[0].advice, AllOf(HasSubstr("firewalls"), HasSubstr("VPN")));
  EXPECT_THAT(ReachText(reach), HasSubstr("BAD   server does not hear robot1"));
  EXPECT_EQ(ReachJson(reach)["troubles"][0]["member"], "server");
}

TEST_F(ReachSurveyTest, WhoIsHeardAndDoesNotAnswerIsToldWithItsAddress) {
  const Reach reach = After({ServersAnswer({Heard("robot1")})});
  ASSERT_THAT(reach.troubles, SizeIs(1));
  EXPECT_EQ(reach.troubles[0].what, "server hears robot1, which does not answer");
  EXPECT_THAT(reach.troubles[0].advice, HasSubstr("10.0.0.7:41830"));
  EXPECT_EQ(ReachJson(reach)["members"][0]["answers"], false);
  EXPECT_EQ(ReachJson(reach)["members"][0]["discovery"], nullptr);
}

TEST_F(ReachSurveyTest, WhoIsExpectedAndNotHeardIsToldOnce) {
  const Reach reach = After({ServersAnswer({})}, {AgentId("robot9"), AgentId("server")});
  ASSERT_THAT(reach.troubles, SizeIs(1));
  EXPECT_EQ(reach.troubles[0].what, "nobody hears robot9");
  EXPECT_THAT(reach.troubles[0].advice, HasSubstr("--server-address"));
  EXPECT_THAT(ReachText(reach), HasSubstr("robot9           -         -         nobody"));
}

TEST_F(ReachSurveyTest, MembersOfAMeshHaveToHearOneAnotherAndThoseOfAStarNot) {
  EXPECT_TRUE(After({AnswerOf("a", {}, true), AnswerOf("b", {}, true)}).complete());
  EXPECT_TRUE(After({AnswerOf("a", {}, true), AnswerOf("b", {}, false)}).complete());
  EXPECT_TRUE(
      After({AnswerOf("a", {Heard("b")}, false), AnswerOf("b", {Heard("a")}, false)}).complete());
  const Reach reach = After({AnswerOf("a", {Heard("b")}, false), AnswerOf("b", {}, false)});
  ASSERT_THAT(reach.troubles, SizeIs(1));
  EXPECT_EQ(reach.troubles[0].what, "b does not hear a, which hears it");
}

TEST_F(ReachSurveyTest, ServersHaveToHearEachOther) {
  const Reach reach = After({ServersAnswer({}, "one"), ServersAnswer({HeardServer("one")}, "two")});
  ASSERT_THAT(reach.troubles, SizeIs(1));
  EXPECT_EQ(reach.troubles[0].what, "one does not hear two, which hears it");
}

TEST_F(ReachSurveyTest, IsMeasuredOnceAddressesAreKnownAndTheWaysToServersAreTimed) {
  EXPECT_FALSE(IsMeasured(After({ServersAnswer({Heard("a")}), AnswerOf("a", {HeardServer()})})));
  HeardAgent timed = Heard("a");
  timed.round_trip_ms = 1.0;
  EXPECT_TRUE(IsMeasured(After({ServersAnswer({timed}), AnswerOf("a", {HeardServer()})})));
  timed.address.clear();
  EXPECT_FALSE(IsMeasured(After({ServersAnswer({timed}), AnswerOf("a", {HeardServer()})})));
  EXPECT_TRUE(IsMeasured(After({AnswerOf("a", {Heard("b")}), AnswerOf("b", {Heard("a")})})))
      << "without a server nobody times it";
}

TEST_F(ReachSurveyTest, NobodyIsNotWell) {
  const Reach reach = After({});
  EXPECT_FALSE(reach.complete());
  EXPECT_EQ(ReachText(reach), "");
  EXPECT_EQ(ReachJson(reach)["all_hear_each_other"], false);
}

TEST_F(ReachSurveyTest, HearsForItselfAndMeasures) {
  ReachSurvey survey(kDesk, {});
  survey.Hear(
      exchange::AgentStatus{
          .agent = AgentId("robot1"), .instance = 1, .role = AgentRole::kFollower},
      kStart);
  const exchange::ReachRequest asked = survey.Ask(kStart);
  EXPECT_EQ(asked.client, kDesk);
  EXPECT_FALSE(asked.relayed);
  survey.Hear(AnswerOf("robot1", {}), kStart + milliseconds(8));
  const Reach reach = survey.Result(kStart + seconds(1));
  ASSERT_THAT(reach.hearings, SizeIs(1));
  EXPECT_EQ(reach.hearings[0].by, kDesk);
  EXPECT_EQ(reach.hearings[0].heard.round_trip_ms, 8.0);
}

TEST_F(ReachSurveyTest, NewerAnswersReplaceOlderOnesAndThoseForOthersDoNotCount) {
  ReachSurvey survey(kDesk, {});
  (void)survey.Ask(kStart);
  (void)survey.Ask(kStart);
  ReachReport first = ServersAnswer({Heard("a"), Heard("b")});
  ReachReport second = ServersAnswer({Heard("c")});
  second.request = 2;
  ReachReport more = ServersAnswer({Heard("d")});
  more.request = 2;
  more.before = 1;
  ReachReport others = ServersAnswer({Heard("e")});
  others.client = AgentId("other-desk");
  ReachReport never_asked = ServersAnswer({Heard("f")});
  never_asked.request = 3;
  for (const ReachReport& report : {first, second, more, first, others, never_asked}) {
    survey.Hear(report, kStart);
  }
  const Reach reach = survey.Result(kStart);
  ASSERT_THAT(reach.hearings, SizeIs(2));
  EXPECT_EQ(reach.hearings[0].heard.agent, AgentId("c"));
  EXPECT_EQ(reach.hearings[1].heard.agent, AgentId("d"));
}

}  // namespace
}  // namespace trailcast::fleet
