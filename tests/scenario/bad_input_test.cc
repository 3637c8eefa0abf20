// These test what people get wrong: each time there is one clear line and an exit status, and
// nothing is spoilt.
#include <fstream>

#include "services/image/files.h"
#include "tests/scenario/programs.h"

namespace trailcast::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class BadInputTest : public ProgramsTest {
 protected:
  void Write(const std::string& name, const std::string& text) {
    std::ofstream(folder_ / name) << text;
  }
};

TEST_F(BadInputTest, AStoreThatIsNotThereHasNothingToDeliver) {
  const auto run = RunAgent({"deliver", "--store", Path("nowhere.db")});
  EXPECT_EQ(run.status, 1);
  EXPECT_THAT(run.output, AllOf(HasSubstr("there is no route store"), HasSubstr("nowhere.db")));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "nowhere.db"));
}

TEST_F(BadInputTest, FramesThatAreNotThere) {
  const auto run = RunAgent(TeachWords(Path("nowhere"), "a.db"));
  EXPECT_EQ(run.status, 1);
  EXPECT_THAT(run.output, HasSubstr("nowhere"));
}

TEST_F(BadInputTest, AFrameThatCannotBeRead) {
  const auto walk = Walk("walk", 100);
  Write("walk/00100.png", "\x89PNG and then nothing");
  const auto run = RunAgent(TeachWords(walk, "a.db"));
  EXPECT_EQ(run.status, 0);
  EXPECT_THAT(run.output, AllOf(HasSubstr("1 of 101 pictures cannot be read"),
                                HasSubstr("00100.png"), HasSubstr("left out")));
}

TEST_F(BadInputTest, FramesOfWhichTooManyCannotBeRead) {
  const auto walk = Walk("walk", 100);
  for (int i = 100; i < 120; ++i) Write(fmt::format("walk/{:05}.png", i), "");
  const auto run = RunAgent(TeachWords(walk, "a.db"));
  EXPECT_EQ(run.status, 1);
  EXPECT_THAT(run.output, AllOf(HasSubstr("00100.png"), HasSubstr("too many to go on"),
                                HasSubstr("segments taught before are kept")));
}

TEST_F(BadInputTest, AFrameOfAnotherSizeMidway) {
  const auto walk = Walk("walk", 100);
  WriteWalk(folder_ / "walk", 1, 320, 240, 100);
  const auto run = RunAgent(TeachWords(walk, "a.db"));
  EXPECT_EQ(run.status, 1);
  EXPECT_THAT(run.output, AllOf(HasSubstr("320x240"), HasSubstr("160x120")));
}

TEST_F(BadInputTest, NothingButDarkness) {
  std::filesystem::create_directories(folder_ / "dark");
  const image::GrayImage black{160, 120, std::vector<std::uint8_t>(160UL * 120UL, 0)};
  for (const char* name : {"0.png", "1.png", "2.png"}) {
    ASSERT_TRUE(image::WritePng(black, folder_ / "dark" / name));
  }
  const auto run = RunAgent(TeachWords(Path("dark"), "a.db"));
  EXPECT_EQ(run.status, 1);
  EXPECT_THAT(run.output, AllOf(HasSubstr("too few features"), HasSubstr("nothing was taught")));
}

TEST_F(BadInputTest, OdometryOfAnotherRun) {
  const auto walk = Walk("walk", 100);
  Write("odo.csv", "t_s,x_m,y_m,heading_rad\n0,0,0,0\n1,0.5,0,0\n");
  const auto run = RunAgent(With(TeachWords(walk, "a.db"), {"--odometry", Path("odo.csv")}));
  EXPECT_EQ(run.status, 1);
  EXPECT_THAT(run.output, AllOf(HasSubstr("odo.csv"), HasSubstr("--rate")));
}

TEST_F(BadInputTest, AnUnknownKeyInTheConfiguration) {
  Write("agent.toml", "domain = 3\n[teach]\nrouet = \"hall\"\n");
  const auto run = RunAgent(With(TeachWords("x", "a.db"), {"--config", Path("agent.toml")}));
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.output, AllOf(HasSubstr("'teach.rouet'"), HasSubstr("in [teach]: route")));
}

TEST_F(BadInputTest, AnUnknownFlag) {
  const auto agent = RunAgent({"teach", "--rout", "hall"});
  EXPECT_EQ(agent.status, 2);
  EXPECT_THAT(agent.output, AllOf(HasSubstr("--rout"), HasSubstr("--help")));
  const auto server = Start("trailcast-server", {"--stoore", Path("a.db")}, "server");
  const auto run = End(*server);
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.output, HasSubstr("--stoore"));
}

TEST_F(BadInputTest, NeitherFramesNorASimulatedWorldNorARobot) {
  const auto run = RunAgent({"teach", "--route", "hall", "--store", Path("a.db")});
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.output, HasSubstr("--frames, --bag, --sim or --ros2"));
}

TEST_F(BadInputTest, WhoIsOnDutyIsOfferedNoRecording) {
  const auto help = RunAgent({"serve", "--help-all"});
  EXPECT_EQ(help.status, 0);
  EXPECT_THAT(help.output, AllOf(HasSubstr("--sim"), HasSubstr("--ros2"), HasSubstr("--logs")));
  for (const char* option : {"--frames", "--bag", "--odometry", "--rate", "--frame-times"}) {
    EXPECT_THAT(help.output, Not(HasSubstr(std::string("\n  ") + option)));
    const auto run = RunAgent({"serve", "--store", Path("a.db"), option, "x"});
    EXPECT_EQ(run.status, 2) << run.output;
    EXPECT_THAT(run.output, HasSubstr(option));
  }
  const auto run = RunAgent({"serve", "--store", Path("a.db")});
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.output, AllOf(HasSubstr("--sim or --ros2"), Not(HasSubstr("--frames"))));
}

TEST_F(BadInputTest, ALogThatIsNoMcapFile) {
  const auto run = RunAgent(With(ReplayWords(Path("walk"), "a.db"), {"--log", Path("run.log")}));
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.output, AllOf(HasSubstr("--log"), HasSubstr("run.log"),
                                HasSubstr("expected a name that ends in .mcap")));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "run.log"));
  Write("run.log", "# trailcast replay log 1\n");
  const auto told = End(*Start("trailcast", {"explain", Path("run.log")}, "explain"));
  EXPECT_EQ(told.status, 1);
  EXPECT_THAT(told.output, HasSubstr("not a replay's log: it is no MCAP file"));
}

// People's scripts say where a robot begins: whichever way they do, it is the route that is
// missing.
TEST_F(BadInputTest, EachWayToSayWhereARobotBeginsIsUnderstood) {
  const std::string walk = Walk("walk", 2);
  for (const Words& begins :
       {Words{"--from-start"}, Words{"--start", "beginning"}, Words{"--start", "anywhere"}}) {
    const auto run = RunAgent(With(ReplayWords(walk, "a.db"), begins));
    EXPECT_EQ(run.status, 1) << run.output;
    EXPECT_THAT(run.output, HasSubstr("no route"));
  }
}

TEST_F(BadInputTest, ANameThatIsNone) {
  const auto run = RunAgent(With(TeachWords("x", "a.db"), {"--name", "Dr. Who?"}));
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.output, AllOf(HasSubstr("--name"), HasSubstr("letters, digits")));
}

TEST_F(BadInputTest, ARouteThatIsNotInTheStore) {
  ASSERT_EQ(RunAgent(TeachWords(Walk("walk", kTaughtFrames), "a.db")).status, 0);
  const auto run =
      RunAgent({"replay", "--frames", Path("walk"), "--route", "hell", "--store", Path("a.db")});
  EXPECT_EQ(run.status, 1);
  EXPECT_THAT(run.output, AllOf(HasSubstr("no route 'hell'"), HasSubstr("did you mean 'hall'?")));
}

TEST_F(BadInputTest, AStoreThatIsNone) {
  const std::string garbage(5000, 'x');
  Write("a.db", garbage);
  for (const auto& words :
       {TeachWords(Walk("walk", 2), "a.db"), ReplayWords(Path("walk"), "a.db")}) {
    const auto run = RunAgent(words);
    EXPECT_EQ(run.status, 1);
    EXPECT_THAT(run.output, HasSubstr("a.db"));
  }
  const auto server = Start("trailcast-server", {"--store", Path("a.db")}, "server");
  EXPECT_EQ(End(*server).status, 1);
  std::ifstream stream(folder_ / "a.db");
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(stream), {}), garbage) << "left untouched";
}

TEST_F(BadInputTest, AReportThatCannotBeWritten) {
  const auto run = RunAgent(
      With(TeachWords(Walk("walk", kTaughtFrames), "a.db"), {"--report", Path("no/report.txt")}));
  EXPECT_EQ(run.status, 1);
  EXPECT_THAT(run.output, HasSubstr("no/report.txt"));
}

TEST_F(BadInputTest, AWorldWithoutAPath) {
  const auto run =
      RunAgent({"teach", "--sim", "atlantis", "--route", "hall", "--store", Path("a.db")});
  EXPECT_EQ(run.status, 1);
  EXPECT_THAT(run.output, AllOf(HasSubstr("atlantis"), HasSubstr("indoor")));
}

}  // namespace
}  // namespace trailcast::test
