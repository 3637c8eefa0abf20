// Robots that are going somewhere, and what they do when operators close their way.
#include <cmath>
#include <cstdio>

#include "tests/scenario/robots.h"

namespace trailcast::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;

// The hall leads straight on to the office, the yard round by a way of its own: it leaves the hall
// at 1.5 m.
class ReplanningTest : public RobotsTest {
 protected:
  void SetUp() override {
    Teach("routes.db", "1,1.5\n5,1.5\n", "hall");
    Teach("routes.db", "1,1.5\n2.8,1.5\n3.5,1.9\n4.6,1.9\n5.3,1.5\n6,1.5\n", "yard");
    Teach("routes.db", "4,1.5\n6.5,1.5\n", "office");
    server_ = Server();
    const Ended delivered = RunAgent({"deliver", "--store", Path("routes.db"), "--name", "scout"});
    ASSERT_EQ(delivered.status, 0) << delivered.output;
    for (const Words& edit :
         {Words{"join", "hall@1.5", "yard@1.5"}, Words{"join", "hall@3.9", "office@0.9"},
          Words{"join", "yard@4.7", "office@1.5"},
          // So slowly that there is time to close it.
          Words{"limit", "hall", "..1.5", "speed", "0.2"}}) {
      const Ended joined = Network(edit);
      ASSERT_EQ(joined.status, 0) << joined.output;
    }
    robot_ = Robot("robot1", {"--sim-truth", Path("truth.csv")});
    agent_ = Serve("robot1");
    ASSERT_TRUE(agent_->WaitForOutput("available as 'robot1'")) << agent_->output();
  }
  Ended Tool(const Words& words) {
    return End(*Start("trailcast", words, "tool" + std::to_string(++tools_)));
  }
  Ended Network(const Words& words) { return Tool(With({"network"}, words)); }
  std::unique_ptr<Process> Send(const Words& words) {
    return Start("trailcast", With({"send", "robot1"}, words), "send" + std::to_string(++tools_));
  }
  // Where it was on the closed part of the hall; on the yard it drives beside that.
  std::string OnClosedPart() {
    std::ifstream in(Path("truth.csv"));
    std::string on;
    for (std::string line; std::getline(in, line) && !in.eof();) {
      double x_m = 0.0;
      double y_m = 0.0;
      if (std::sscanf(line.c_str(), "%*[^,],%lf,%lf", &x_m, &y_m) != 2) continue;
      if (x_m > 3.8 && x_m < 4.4 && std::abs(y_m - 1.5) < 0.2) on += line + "\n";
    }
    return on;
  }

  std::unique_ptr<Process> server_;
  std::unique_ptr<Process> robot_;
  std::unique_ptr<Process> agent_;
  int tools_ = 0;
};

TEST_F(ReplanningTest, ARobotUnderWayGoesRoundWhatIsClosedMeanwhile) {
  const auto sent = Send({"goto", "office@2.2", "--from", "hall@0", "--id", "trip", "--wait"});
  ASSERT_TRUE(agent_->WaitForOutput("follow hall 1.5..3.9")) << sent->output() << agent_->output();
  ASSERT_TRUE(agent_->WaitForOutput("trip of operator")) << agent_->output();
  ASSERT_TRUE(agent_->WaitForOutput("under way")) << agent_->output();
  const Ended closed = Network({"close", "hall", "2.8..3.4"});
  EXPECT_EQ(closed.status, 0) << closed.output;
  EXPECT_THAT(closed.output, AllOf(HasSubstr("close hall 2.8..3.4"),
                                   HasSubstr("robot1: mission trip is re-planned: hall 2.8..3.4 "
                                             "was closed: follow hall")));
  const Ended arrived = End(*sent);
  EXPECT_EQ(arrived.status, 0) << arrived.output << agent_->output() << server_->output();
  EXPECT_THAT(arrived.output, AllOf(HasSubstr("robot1: under way: re-planned: hall 2.8..3.4 was "
                                              "closed"),
                                    HasSubstr("robot1: arrived")));
  EXPECT_THAT(OnClosedPart(), IsEmpty());
  EXPECT_NEAR(Along_m("truth.csv"), 6.2, 0.3);
  EXPECT_THAT(Tool({"missions"}).output, AllOf(HasSubstr("goto office@2.2 way 2 follow hall"),
                                               HasSubstr("follow yard 1.5..")));
}

TEST_F(ReplanningTest, WithoutAnotherWayItStandsUntilThereIsOneAlsoIfTheServerHasStartedAgain) {
  const auto sent = Send({"goto", "office@2.2", "--from", "hall@0", "--id", "trip", "--wait"});
  ASSERT_TRUE(agent_->WaitForOutput("under way")) << sent->output() << agent_->output();
  const Ended closed = Network({"close", "office", "1.6..2"});
  EXPECT_THAT(closed.output, HasSubstr("robot1: mission trip waits for a way: office 1.6..2 was "
                                       "closed; every way from"));
  ASSERT_TRUE(sent->WaitForOutput("robot1: fetching: waits for a way: office 1.6..2 was closed"))
      << sent->output() << agent_->output();
  ASSERT_TRUE(Stands("truth.csv"));
  EXPECT_LT(Along_m("truth.csv"), 3.8);
  server_->Signal(SIGKILL);
  (void)End(*server_);
  server_ = Server("server.db", "server2");
  const Ended still = Tool({"missions", "--state", "fetching"});
  EXPECT_THAT(still.output, AllOf(HasSubstr("trip"), HasSubstr("wait way")));
  const Ended opened = Network({"open", "office"});
  EXPECT_EQ(opened.status, 0) << opened.output;
  const Ended arrived = End(*sent);
  EXPECT_EQ(arrived.status, 0) << arrived.output << agent_->output() << server_->output();
  EXPECT_THAT(arrived.output, HasSubstr("re-planned: there is a way"));
  EXPECT_NEAR(Along_m("truth.csv"), 6.2, 0.3);
}

}  // namespace
}  // namespace trailcast::test
