// Two robots that come towards each other where they cannot pass.
#include "tests/scenario/robots.h"

namespace trailcast::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class MeetingTest : public RobotsTest {
 protected:
  static constexpr const char* kOut = "1,1.5\n5,1.5\n";
  static constexpr const char* kBack = "5,1.5\n1,1.5\n";

  Ended Tool(const Words& words) {
    return End(*Start("trailcast", words, "tool" + std::to_string(++tools_)));
  }
  std::unique_ptr<Process> Send(const std::string& robot, const Words& words) {
    return Start("trailcast", With({"send", robot}, words), "send-" + robot);
  }
  std::unique_ptr<Process> OnDuty(const std::string& robot) {
    auto agent = Agent(With({"serve", "--store", Path(robot + ".db"), "--name", robot,
                             "--max-speed", kUnhurried_mps},
                            Drives(robot)),
                       "duty-" + robot);
    EXPECT_TRUE(agent->WaitForOutput("available as '" + robot + "'")) << agent->output();
    return agent;
  }

  int tools_ = 0;
};

TEST_F(MeetingTest, OneWaitsUntilTheOtherHasLeftWhatIsNarrowAlsoIfTheServerHasStartedAgain) {
  Teach("routes.db", kOut, "hall");
  Teach("routes.db", kBack, "back");
  auto server = Server();
  const Ended delivered = RunAgent({"deliver", "--store", Path("routes.db"), "--name", "scout"});
  ASSERT_EQ(delivered.status, 0) << delivered.output;
  for (const Words& edit : {Words{"limit", "hall", "speed", "0.3"},
                            Words{"narrow", "hall", "1.5..2.5", "back", "1.5..2.5"}}) {
    const Ended done = Tool(With({"network"}, edit));
    ASSERT_EQ(done.status, 0) << done.output;
  }
  const auto robot1 = Robot("robot1", {"--sim-truth", Path("truth1.csv")}, kOut);
  const auto robot2 = Robot("robot2", {"--sim-truth", Path("truth2.csv")}, kBack);
  const auto agent1 = OnDuty("robot1");
  const auto agent2 = OnDuty("robot2");

  const auto sent1 = Send("robot1", {"goto", "hall@3.8", "--from", "hall@0", "--wait"});
  ASSERT_TRUE(server->WaitForOutput("enters hall 1.5..2.5")) << sent1->output() << server->output();
  const auto sent2 = Send("robot2", {"goto", "back@3.8", "--from", "back@0", "--wait"});
  ASSERT_TRUE(sent2->WaitForOutput("robot2: fetching: waits for robot1 to leave hall 1.5..2.5"))
      << sent2->output() << agent2->output() << server->output();
  EXPECT_GT(Along_m("truth2.csv"), 3.5);
  EXPECT_THAT(Tool({"network"}).output,
              HasSubstr("narrow hall 1.5..2.5 back 1.5..2.5, taken by robot1"));
  EXPECT_THAT(Tool({"missions", "--robot", "robot2"}).output,
              HasSubstr("waits for robot1 to leave hall 1.5..2.5"));
  server->Signal(SIGKILL);
  (void)End(*server);
  server = Server("server.db", "server2");
  const Ended arrived1 = End(*sent1);
  EXPECT_EQ(arrived1.status, 0) << arrived1.output << agent1->output() << server->output();
  const Ended arrived2 = End(*sent2);
  EXPECT_EQ(arrived2.status, 0) << arrived2.output << agent2->output() << server->output();
  EXPECT_THAT(arrived2.output, AllOf(HasSubstr("enters hall 1.5..2.5"), HasSubstr("arrived")));
  const std::string log = server->output();
  const std::size_t left = log.find("robot1 has left hall 1.5..2.5");
  const std::size_t entered = log.find("enters hall 1.5..2.5");
  EXPECT_LT(left, entered) << log;
  EXPECT_NE(entered, std::string::npos) << log;
  EXPECT_NEAR(Along_m("truth1.csv"), 4.8, 0.3);
  EXPECT_NEAR(Along_m("truth2.csv"), 1.2, 0.3);
}

}  // namespace
}  // namespace trailcast::test
