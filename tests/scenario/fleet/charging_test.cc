// Robots whose batteries fall, and a dock.
#include "tests/scenario/robots.h"

namespace trailcast::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class ChargingScenario : public RobotsTest {
 protected:
  ChargingScenario() { most_mps_ = kUnwatched_mps; }
  Ended Tool(const Words& words) {
    return End(*Start("trailcast", words, "tool" + std::to_string(++tools_)));
  }
  Ended Network(const Words& words) { return Tool(With({"network"}, words)); }
  // Returns the list of the network once it says so.
  std::string Says(const std::string& words) {
    std::string listed;
    Await(
        [&] {
          listed = Network({}).output;
          return listed.find(words) != std::string::npos;
        },
        words);
    return listed;
  }

  int tools_ = 0;
};

// The first robot comes to the dock in reverse gear after its mission. The second one was never
// sent anywhere, so that it does not know where it is.
TEST_F(ChargingScenario, ARobotChargesAtTheDockAndGoesOnAndOneThatIsLostSaysSo) {
  Teach();
  const auto server = Server();
  const Ended delivered = RunAgent({"deliver", "--store", Path("routes.db"), "--name", "scout"});
  ASSERT_EQ(delivered.status, 0) << delivered.output;
  ASSERT_EQ(Network({"back", "hall", "0.5..3.5"}).status, 0);
  const Ended dock = Network({"name", "dock1", "hall@1", "dock"});
  ASSERT_EQ(dock.status, 0) << dock.output;
  EXPECT_THAT(dock.output, HasSubstr("name dock1 hall@1 dock"));
  const Ended charge = Network({"charge", "below", "70", "until", "80"});
  ASSERT_EQ(charge.status, 0) << charge.output;
  EXPECT_THAT(charge.output, HasSubstr("charge below 70 until 80"));

  const auto robot1 = Robot("robot1", {"--sim-truth", Path("truth.csv"), "--sim-battery", "0.3",
                                       "--sim-charger", "2,1.5@0.3"});
  const auto robot2 = Robot("robot2", {"--sim-battery", "0.3"});
  const auto agent1 = Serve("robot1");
  const auto agent2 = Serve("robot2", "duty2");
  ASSERT_TRUE(agent1->WaitForOutput("available as 'robot1'")) << agent1->output();
  const Ended sent = Tool({"send", "robot1", "follow", "hall", "..3", "--wait"});
  ASSERT_EQ(sent.status, 0) << sent.output << agent1->output();
  EXPECT_THAT(Says("charges at dock1: its battery is at"),
              AllOf(HasSubstr("name dock1 hall@1 dock, taken by robot1"),
                    HasSubstr("robot2 is to charge, its battery is at"),
                    HasSubstr("waits: it does not know where it is")));
  EXPECT_NEAR(Along_m("truth.csv"), 2.0, 0.3);
  const Ended on = Tool({"send", "robot1", "follow", "hall", "1..2", "--wait"});
  EXPECT_EQ(on.status, 0) << on.output << agent1->output();
  EXPECT_THAT(on.output, HasSubstr("waits: it charges at dock1"));
  EXPECT_NEAR(Along_m("truth.csv"), 3.0, 0.3);
  const std::string missions = Tool({"missions", "--robot", "robot1"}).output;
  EXPECT_THAT(missions, AllOf(HasSubstr("charge-"), HasSubstr("arrived")));
}

}  // namespace
}  // namespace trailcast::test
