// Routes of two scouts that come to the same place: found by the server, and an operator's to join.
#include <csignal>
#include <filesystem>
#include <fstream>

#include "tests/scenario/programs.h"

namespace trailcast::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class ProposalsTest : public ProgramsTest {
 protected:
  Ended Network(const Words& words) {
    return End(*Start("trailcast", With({"network"}, words), "tool" + std::to_string(++tools_)));
  }
  std::string Passing(const std::string& place) {
    const Ended asked = Network({"passing", place});
    EXPECT_EQ(asked.status, 0) << asked.output;
    return asked.output;
  }
  // How far along it that route is, by such an answer.
  static double PassesAt(const std::string& answer, const std::string& route) {
    const std::string before = "\n  " + route + "@";
    const std::string::size_type at = answer.find(before);
    EXPECT_NE(at, std::string::npos) << answer;
    return at == std::string::npos ? -1.0 : std::stod(answer.substr(at + before.size()));
  }
  static void Stop(Process& server) {
    server.Signal(SIGTERM);
    EXPECT_EQ(server.Wait(), 0) << server.output();
  }
  // Through the laboratory, from so far along one way.
  Ended Teach(const std::string& route, double from_x_m) {
    std::ofstream(Path(route + ".csv"))
        << "x_m,y_m\n"
        << from_x_m << ",1.5\n6,1.5\n7.2,3.2\n7.2,5.6\n5.8,7\n2.3,7\n";
    return RunAgent({"teach", "--sim", "indoor", "--path", Path(route + ".csv"), "--speed", "0.8",
                     "--seed", route == "hall" ? "3" : "5", "--route", route, "--name",
                     "scout-" + route, "--store", Path(route + ".db"), "--server"});
  }

  int tools_ = 0;
};

TEST_F(ProposalsTest, AJunctionThatIsFoundIsAnOperatorsToMakeOrToRefuse) {
  auto server = Server();
  const Ended hall = Teach("hall", 1.0);
  ASSERT_EQ(hall.status, 0) << hall.output;
  EXPECT_THAT(hall.output, Not(HasSubstr("crosses")));
  const Ended office = Teach("office", 3.0);
  ASSERT_EQ(office.status, 0) << office.output;
  EXPECT_THAT(office.output, HasSubstr("what is being taught crosses hall at ")) << "at once";
  ASSERT_TRUE(server->WaitForOutput("proposed join ")) << server->output();
  const Ended listed = Network({"proposals"});
  EXPECT_EQ(listed.status, 0) << listed.output;
  EXPECT_THAT(listed.output,
              AllOf(HasSubstr("proposed join "), HasSubstr(" office@"), HasSubstr(" hall@"),
                    HasSubstr(" both"), HasSubstr(" confidence 0.9")));
  const Ended none = Network({"way", "hall@1", "office@8"});
  EXPECT_EQ(none.status, 1) << "it is proposed, and no more than that: " << none.output;
  EXPECT_THAT(Passing("hall@10"), HasSubstr("  proposed join "));
  EXPECT_NEAR(PassesAt(Passing("hall@10"), "office"), 8.0, 0.6);
  EXPECT_NEAR(PassesAt(Passing("office@8"), "hall"), 10.0, 0.6);
  EXPECT_THAT(Passing("hall@0.2"), HasSubstr("no other route is known to pass at hall@0.2: "));
  EXPECT_THAT(Network({"passing", "hall@99"}).output, HasSubstr("there is no 99 m on it"));
  EXPECT_THAT(Network({"passing"}).output, HasSubstr("takes one place: ROUTE@METRES"));
  Stop(*server);
  std::filesystem::copy(Path("server.db"), Path("other.db"));
  std::filesystem::copy(Path("server.db.joints"), Path("other.db.joints"));

  server = Server();
  const Ended confirmed = Network({"confirm", "all", "above", "0.9"});
  EXPECT_EQ(confirmed.status, 0) << confirmed.output;
  EXPECT_THAT(confirmed.output, AllOf(HasSubstr("join "), Not(HasSubstr("proposed"))));
  const Ended way = Network({"way", "hall@1", "office@8"});
  EXPECT_EQ(way.status, 0) << way.output;
  EXPECT_THAT(way.output, AllOf(HasSubstr("follow hall 1.."), HasSubstr("follow office ")));
  EXPECT_THAT(Network({"proposals"}).output, Not(HasSubstr("confidence 0.9")));
  EXPECT_THAT(Passing("hall@10"), AllOf(HasSubstr("  join "), Not(HasSubstr("proposed"))));
  EXPECT_NEAR(PassesAt(Passing("hall@10"), "office"), 8.0, 0.6) << "also after a restart";
  Stop(*server);

  server = Server("other.db");
  const Ended refused = Network({"refuse", "all"});
  EXPECT_EQ(refused.status, 0) << refused.output;
  EXPECT_THAT(refused.output, HasSubstr("no more: proposed join "));
  Stop(*server);
  server = Server("other.db");
  EXPECT_THAT(Network({"proposals"}).output, HasSubstr("no junctions are proposed"));
  EXPECT_EQ(Network({"way", "hall@1", "office@8"}).status, 1);
}

}  // namespace
}  // namespace trailcast::test
