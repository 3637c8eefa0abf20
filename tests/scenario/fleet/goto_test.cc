// Routes that are joined, and a robot sent to a place over them.
#include "tests/scenario/robots.h"

namespace trailcast::test {
namespace {

using testing::AllOf;
using testing::AnyOf;
using testing::HasSubstr;

class GotoTest : public RobotsTest {
 protected:
  GotoTest() { most_mps_ = kUnwatched_mps; }
  Ended Tool(const Words& words) {
    return End(*Start("trailcast", words, "tool" + std::to_string(++tools_)));
  }
  Ended Network(const Words& words) { return Tool(With({"network"}, words)); }
  Ended Send(const Words& words) { return Tool(With({"send", "robot1"}, words)); }

  // Frames in which it stood between two places along its path.
  int StoodBetween(double from_x_m, double to_x_m) {
    const std::vector<Place> places = TruePlaces();
    int stood = 0;
    for (std::size_t i = 1; i < places.size(); ++i) {
      const double x_m = places[i].x_m;
      if (x_m > from_x_m && x_m < to_x_m && x_m - places[i - 1].x_m < 1e-3) ++stood;
    }
    return stood;
  }

  int tools_ = 0;
};

// The office was taught along the hall, so that a robot that changes over goes straight on.
TEST_F(GotoTest, ARobotChangesOverAtAJunctionAndKeepsOutOfWhatIsClosed) {
  Teach();
  Teach("routes.db", kPath, "office");
  const auto server = Server();
  const Ended delivered = RunAgent({"deliver", "--store", Path("routes.db"), "--name", "scout"});
  ASSERT_EQ(delivered.status, 0) << delivered.output;
  const Ended joined = Network({"join", "hall@1.5", "office@1.5"});
  ASSERT_EQ(joined.status, 0) << joined.output;
  EXPECT_THAT(joined.output, HasSubstr("join hall@1.5 office@1.5"));
  const Ended way = Network({"way", "hall@0.5", "office@3"});
  EXPECT_EQ(way.status, 0) << way.output;
  EXPECT_THAT(way.output, AllOf(HasSubstr("follow hall 0.5..1.5"),
                                HasSubstr("follow office 1.5..3"), HasSubstr("2.5 m")));
  const Ended closed = Network({"close", "office", "2..2.5"});
  ASSERT_EQ(closed.status, 0) << closed.output;

  const auto robot = Robot("robot1", {"--sim-truth", Path("truth.csv")});
  const auto agent = Serve("robot1");
  ASSERT_TRUE(agent->WaitForOutput("available as 'robot1'")) << agent->output();
  const Ended barred = Send({"goto", "office@3", "--from", "hall@0"});
  EXPECT_EQ(barred.status, 1) << barred.output;
  EXPECT_THAT(barred.output, AllOf(HasSubstr("closed"), HasSubstr("office 2..2.5")));
  ASSERT_EQ(Network({"open", "office"}).status, 0);
  const Ended sent = Send({"goto", "office@3", "--from", "hall@0", "--wait"});
  EXPECT_EQ(sent.status, 0) << sent.output << agent->output();
  EXPECT_THAT(sent.output, AllOf(HasSubstr("follow office 1.5..3"), HasSubstr("robot1: arrived")));
  EXPECT_NEAR(Along_m("truth.csv"), 4.0, 0.3);
  EXPECT_THAT(agent->output(), HasSubstr("where it changed over"));
  EXPECT_EQ(StoodBetween(1.2, 3.7), 0) << agent->output();

  const Ended back = Send({"goto", "hall@1"});
  EXPECT_EQ(back.status, 1) << back.output;
  EXPECT_THAT(back.output, HasSubstr("no way leads from office@")) << "from where it says it is";
  const Ended nowhere = Send({"goto", "loading-bay"});
  EXPECT_EQ(nowhere.status, 1) << nowhere.output;
  EXPECT_THAT(nowhere.output, HasSubstr("no place is called 'loading-bay'"));
  const Ended spaced = Network({"name", "loading bay", "office@3.4"});
  EXPECT_EQ(spaced.status, 2) << spaced.output;
  EXPECT_THAT(spaced.output,
              AllOf(HasSubstr("'loading bay' has a space"), HasSubstr("'loading-bay'")));
  const Ended named = Network({"name", "loading-bay", "office@3.4"});
  ASSERT_EQ(named.status, 0) << named.output;
  EXPECT_THAT(Network({}).output, HasSubstr("name loading-bay office@3.4"));
  const Ended on = Send({"goto", "loading-bay", "--wait"});
  EXPECT_EQ(on.status, 0) << on.output << agent->output();
  EXPECT_NEAR(Along_m("truth.csv"), 4.4, 0.3);
  EXPECT_THAT(Tool({"missions"}).output, HasSubstr("follow hall 0..1.5 follow office 1.5..3"));
}

// Set down round the corner, upon a route that its way does not lead over, and of which it has
// nothing: a server tells it what looks like that.
TEST_F(GotoTest, ARobotThatIsCarriedToAnotherRouteFindsItselfThereAndIsLedOn) {
  Teach("routes.db", "1,1.5\n6,1.5\n");
  Teach("routes.db", "5,1.5\n6,1.5\n7.2,3.2\n", "office");
  Teach("routes.db", "7.2,3.2\n7.2,5.6\n", "dock");
  const auto server = Server();
  const Ended delivered = RunAgent({"deliver", "--store", Path("routes.db"), "--name", "scout"});
  ASSERT_EQ(delivered.status, 0) << delivered.output;
  ASSERT_EQ(Network({"join", "hall@4.5", "office@0.5"}).status, 0);
  ASSERT_EQ(Network({"join", "dock@2.1", "office@2"}).status, 0);
  const auto robot =
      Robot("robot1", {"--sim-truth", Path("truth.csv"), "--sim-carry", "7.2,4.4,90@1.2"});
  const auto agent = Serve("robot1", "duty", {"--look-around", "0"}, "robot1.db");
  ASSERT_TRUE(agent->WaitForOutput("available as 'robot1'")) << agent->output();
  const Ended sent = Send({"goto", "office@2.5", "--from", "hall@0"});
  ASSERT_EQ(sent.status, 0) << sent.output;
  ASSERT_TRUE(agent->WaitForOutput("re-planned: it has found itself elsewhere")) << agent->output();
  EXPECT_THAT(agent->output(), AllOf(HasSubstr("looks whether it is on hall"),
                                     HasSubstr("it finds itself on dock at 1.")));
  EXPECT_THAT(Tool({"missions"}).output, HasSubstr("follow dock 1"));
  ASSERT_TRUE(agent->WaitForOutput("along the route, where it was to end")) << agent->output();
  // It looks for the next route up to 0.1 m beyond the junction.
  EXPECT_THAT(agent->output(), AnyOf(HasSubstr("arrived: 2.1 m along the route"),
                                     HasSubstr("arrived: 2.2 m along the route")));
  const Place end = TruePlaces().back();
  EXPECT_NEAR(end.x_m, 7.2, 0.2);
  EXPECT_NEAR(end.y_m, 5.3, 0.3) << agent->output();
}

// A dead end, and beside it what was taught the other way.
TEST_F(GotoTest, ARobotBacksOutAndTurnsRound) {
  Teach();
  Teach("routes.db", "4.5,1.5\n1,1.5\n", "home");
  const auto server = Server();
  const Ended delivered = RunAgent({"deliver", "--store", Path("routes.db"), "--name", "scout"});
  ASSERT_EQ(delivered.status, 0) << delivered.output;
  const Ended backed = Network({"back", "hall", "1..3"});
  ASSERT_EQ(backed.status, 0) << backed.output;
  EXPECT_THAT(backed.output, AllOf(HasSubstr("back hall 1..3"), HasSubstr("narrow hall 1..3")));
  ASSERT_EQ(Network({"join", "hall@1.5", "home@2", "heading", "180"}).status, 0);

  const auto robot = Robot("robot1", {"--sim-truth", Path("truth.csv")});
  const auto agent = Serve("robot1");
  ASSERT_TRUE(agent->WaitForOutput("available as 'robot1'")) << agent->output();
  const Ended in = Send({"goto", "hall@2.8", "--from", "hall@0", "--wait"});
  ASSERT_EQ(in.status, 0) << in.output << agent->output();
  EXPECT_NEAR(Along_m("truth.csv"), 3.8, 0.3);
  const Ended home = Send({"goto", "home@2.8", "--wait"});
  ASSERT_EQ(home.status, 0) << home.output << agent->output();
  EXPECT_THAT(home.output, AllOf(HasSubstr("follow hall backwards 2.8"),
                                 HasSubstr("..1.5\nturn 180\nfollow home 2..2.8\n")));
  EXPECT_NEAR(TruePlaces().back().x_m, 1.7, 0.3) << agent->output();
  EXPECT_NEAR(TruePlaces().back().y_m, 1.5, 0.2) << agent->output();
}

}  // namespace
}  // namespace trailcast::test
