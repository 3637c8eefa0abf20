// These test who hears whom, as 'trailcast reach' asks it.
#include <nlohmann/json.hpp>

#include "tests/scenario/programs.h"

namespace trailcast::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class ReachTest : public ProgramsTest {
 protected:
  // With names it ends as soon as these and all others hear each other.
  Ended Reach(const Words& words) {
    return End(*Start("trailcast", With({"reach"}, words), "reach"));
  }
};

TEST_F(ReachTest, AServerAndARobotOfItsStarAreHeardByEachOther) {
  const auto server = Server();
  const auto robot =
      Agent(With(ReplayWords(Walk("walk", 2), "robot.db"),
                 {"--server", "--wait-for-route", "--name", "robot", "--discovery", "star"}),
            "robot");
  const Ended ended = Reach({"server", "robot", "--json", "--listen", "60"});
  ASSERT_EQ(ended.status, 0) << ended.output;
  const auto reach = nlohmann::json::parse(ended.output);
  EXPECT_EQ(reach["all_hear_each_other"], true);
  ASSERT_EQ(reach["members"].size(), 2U) << ended.output;
  const auto& robots = reach["members"][0];
  EXPECT_EQ(robots["name"], "robot");
  EXPECT_EQ(robots["role"], "follower");
  EXPECT_EQ(robots["discovery"], "star");
  const auto by = [](const nlohmann::json& member, const std::string& name) {
    for (const auto& heard : member["heard_by"]) {
      if (heard["by"] == name) return heard;
    }
    return nlohmann::json();
  };
  const auto by_server = by(robots, "server");
  EXPECT_THAT(by_server["address"].get<std::string>(), HasSubstr("127.0.0.1:"));
  EXPECT_EQ(by_server["network_interface"], "lo");
  EXPECT_GT(by_server["round_trip_ms"].get<double>(), 0.0);
  EXPECT_GE(by_server["for_s"].get<double>(), by_server["last_s"].get<double>());
  EXPECT_FALSE(by(reach["members"][1], "robot").is_null()) << ended.output;
}

TEST_F(ReachTest, WhoIsMissingIsNamedWithWhatToDo) {
  const auto server = Server();
  const Ended ended = Reach({"robot9", "--listen", "1"});
  EXPECT_EQ(ended.status, 1);
  EXPECT_THAT(ended.output,
              AllOf(HasSubstr("BAD   nobody hears robot9"), HasSubstr("--server-address")));
}

TEST_F(ReachTest, NobodyIsNoSuccessAndNonsenseIsWrongUsage) {
  const Ended nobody = Reach({"--listen", "1"});
  EXPECT_EQ(nobody.status, 1);
  EXPECT_THAT(nobody.output, HasSubstr("nobody was heard"));
  EXPECT_EQ(Reach({"--listen", "never"}).status, 2);
  EXPECT_EQ(Reach({"no/name"}).status, 2);
}

}  // namespace
}  // namespace trailcast::test
