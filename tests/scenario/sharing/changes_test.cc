// These ask a server what was changed of routes and of how they are joined.
#include <csignal>
#include <filesystem>
#include <fstream>

#include "tests/scenario/programs.h"

namespace trailcast::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class ChangesTest : public ProgramsTest {
 protected:
  Ended Tool(const Words& words) {
    return End(*Start("trailcast", words, "tool" + std::to_string(++tools_)));
  }
  std::string Since(const Words& words) {
    const Ended asked = Tool(With({"routes", "--since"}, words));
    EXPECT_EQ(asked.status, 0) << asked.output;
    return asked.output;
  }
  void Do(const Words& words) {
    const Ended done = Tool(words);
    EXPECT_EQ(done.status, 0) << done.output;
  }
  void Teach(const std::string& route) {
    std::ofstream(Path("path.csv")) << "x_m,y_m\n1,1.5\n4,1.5\n";
    const Ended taught = RunAgent({"teach", "--sim", "indoor", "--camera", kSmallPictures, "--path",
                                   Path("path.csv"), "--speed", "0.8", "--route", route, "--name",
                                   "scout", "--store", Path("scout.db"), "--server"});
    ASSERT_EQ(taught.status, 0) << taught.output;
  }
  static void Stop(Process& server) {
    server.Signal(SIGTERM);
    EXPECT_EQ(server.Wait(), 0) << server.output();
  }

  int tools_ = 0;
};

TEST_F(ChangesTest, WhatWasChangedIsToldWithWhoDidItAlsoAfterARestart) {
  auto server = Server();
  EXPECT_THAT(Since({"today"}), HasSubstr("nothing was changed since "));
  Teach("hall");
  Teach("hall");
  Do({"--name", "desk", "routes", "activate", "hall@2"});
  Do({"--name", "desk", "routes", "rename", "hall", "aisle"});
  Do({"--name", "night-shift", "network", "close", "aisle", "1..2"});
  Do({"--name", "desk", "network", "name", "bay", "aisle@2"});
  Stop(*server);
  server = Server();
  Do({"--name", "desk", "network", "open", "aisle"});
  const std::string told = Since({"1h"});
  const std::string::size_type begin = told.find("open aisle");
  ASSERT_NE(begin, std::string::npos) << told;
  std::string::size_type at = begin;
  for (const char* const what :
       {"desk         name bay aisle@2", "night-shift  close aisle 1..2",
        "desk         renamed hall to aisle", "desk         activated hall@2", "stored hall@2, ",
        "stored hall@1, "}) {
    const auto next = told.find(what, at);
    EXPECT_NE(next, std::string::npos) << what << " in:\n" << told;
    if (next != std::string::npos) at = next;
  }
  EXPECT_THAT(told, AllOf(HasSubstr("scout"), HasSubstr(", active\n"), HasSubstr("kept since ")));
  EXPECT_THAT(Since({"today", "--limit", "1", "--json"}),
              AllOf(HasSubstr("\"by\": \"desk\""), HasSubstr("\"what\": \"open aisle\""),
                    Not(HasSubstr("bay"))));
}

TEST_F(ChangesTest, TwoRevisionsAreComparedAndDrawn) {
  const auto server = Server();
  Teach("hall");
  Teach("hall");
  const Ended compared = Tool({"routes", "diff", "hall@1", "hall@2", "--plot", Path("diff.png")});
  EXPECT_EQ(compared.status, 0) << compared.output;
  EXPECT_THAT(compared.output, AllOf(HasSubstr("hall@2 "), HasSubstr("features stayed, "),
                                     HasSubstr(" m, "), HasSubstr(" kB")));
  EXPECT_GT(std::filesystem::file_size(Path("diff.png")), 1000U);
  EXPECT_THAT(Tool({"routes", "diff", "hall@1", "hall@2", "--json"}).output,
              AllOf(HasSubstr("\"differing\": ["), HasSubstr("\"name\": \"hall\"")));
  const Ended absent = Tool({"routes", "diff", "hall@1", "hall@9"});
  EXPECT_EQ(absent.status, 1);
  EXPECT_THAT(absent.output, HasSubstr("has no revision 9 of route 'hall'; it has 1, 2"));
}

TEST_F(ChangesTest, WhatNobodyMeansOrNobodyKnowsIsRefused) {
  const Ended word = Tool({"routes", "--since", "lately"});
  EXPECT_EQ(word.status, 2);
  EXPECT_THAT(word.output, HasSubstr("--since: 'lately': expected a day (monday, "));
  const Ended both = Tool({"routes", "--since", "monday", "--name", "hall"});
  EXPECT_EQ(both.status, 2);
  // A server whose file cannot be opened serves routes without, and says so.
  std::filesystem::create_directory(Path("server.db.history"));
  const auto server = Server();
  EXPECT_THAT(server->output(), HasSubstr("keeping no history: "));
  const Ended none = Tool({"routes", "--since", "monday"});
  EXPECT_EQ(none.status, 1);
  EXPECT_THAT(none.output, HasSubstr("keeps no history"));
}

}  // namespace
}  // namespace trailcast::test
