#include <gmock/gmock.h>
#include <httplib.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "services/image/files.h"
#include "services/lab/demo/child_process.h"
#include "tests/support/await.h"
#include "tests/support/places.h"
#include "tests/support/temp_dir.h"

namespace trailcast::demo {
namespace {

using std::chrono::seconds;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const std::filesystem::path kPrograms = ProgramsDir();

// Returns as much as can be read: a process may end meanwhile, and its file with it.
std::string Contents(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

// Processes of `program` whose command line names `folder`.
std::vector<pid_t> ProcessesOf(const std::filesystem::path& folder, const std::string& program) {
  std::vector<pid_t> found;
  for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
    const std::string name = entry.path().filename();
    if (!std::all_of(name.begin(), name.end(), [](unsigned char c) { return std::isdigit(c); })) {
      continue;
    }
    const std::string words = Contents(entry.path() / "cmdline");
    if (words.find(folder.string()) != std::string::npos &&
        words.find(program) != std::string::npos) {
      found.push_back(std::stoi(name));
    }
  }
  return found;
}

// A demo with a temporary folder of the test's own, so that what it leaves there is seen.
class DemoTest : public ::testing::Test {
 protected:
  DemoTest() {
    std::filesystem::create_directory(scratch());
    std::filesystem::create_directory(out());
  }
  ChildProcess StartDemo(const std::vector<std::string>& more = {}) {
    std::vector<std::string> words{"/usr/bin/env",
                                   "TMPDIR=" + scratch().string(),
                                   (kPrograms / "trailcast").string(),
                                   "demo",
                                   "--out",
                                   out().string()};
    words.insert(words.end(), more.begin(), more.end());
    auto demo = ChildProcess::Start(words, log());
    EXPECT_TRUE(demo.has_value());
    return std::move(*demo);
  }
  [[nodiscard]] std::filesystem::path scratch() const { return folder_ / "scratch"; }
  [[nodiscard]] std::filesystem::path out() const { return folder_ / "out"; }
  [[nodiscard]] std::filesystem::path log() const { return folder_ / "demo.log"; }
  [[nodiscard]] std::vector<pid_t> Fleet() const {
    std::vector<pid_t> fleet = ProcessesOf(scratch(), "trailcast-agent");
    for (const pid_t server : ProcessesOf(scratch(), "trailcast-server")) fleet.push_back(server);
    return fleet;
  }
  [[nodiscard]] std::vector<std::string> Left(const std::filesystem::path& in) const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(in)) {
      names.push_back(entry.path().filename());
    }
    return names;
  }

 private:
  test::TempDir folder_;
};

TEST_F(DemoTest, AllRobotsArriveAndNothingButThePictureIsLeft) {
  ChildProcess demo = StartDemo();
  ASSERT_TRUE(test::WaitUntil([&] { return demo.Poll().has_value(); }, seconds(540)))
      << Contents(log());
  EXPECT_TRUE(demo.Poll()->ok()) << Contents(log());
  const std::string text = Contents(log());
  for (const char* robot : {"scout", "follower-1", "follower-2", "follower-3"}) {
    EXPECT_THAT(text, HasSubstr(robot));
  }
  EXPECT_THAT(Left(out()), ::testing::ElementsAre("trailcast-demo.png"));
  const auto picture = image::ReadRgb(out() / "trailcast-demo.png");
  ASSERT_TRUE(picture.has_value());
  EXPECT_GT(picture->width, 400);
  EXPECT_THAT(Left(scratch()), IsEmpty());
  EXPECT_THAT(Fleet(), IsEmpty());
}

TEST_F(DemoTest, WhenInterruptedItEndsAllItsProcessesAndTakesItsFilesAway) {
  ChildProcess demo = StartDemo();
  // Well under way: one server and four agents, and the operator has heard of the teaching.
  ASSERT_TRUE(test::WaitUntil([&] {
    return Fleet().size() == 5 && Contents(log()).find(" teaching ") != std::string::npos;
  })) << Contents(log());
  EXPECT_EQ(Left(scratch()).size(), 1U);
  const std::vector<pid_t> demos = ProcessesOf(out(), "trailcast");
  ASSERT_EQ(demos.size(), 1U);
  ASSERT_EQ(kill(demos.front(), SIGINT), 0);
  ASSERT_TRUE(test::WaitUntil([&] { return demo.Poll().has_value(); })) << Contents(log());
  EXPECT_EQ(demo.Poll()->code, 130);
  EXPECT_THAT(Contents(log()), HasSubstr("interrupted"));
  EXPECT_THAT(Fleet(), IsEmpty());
  EXPECT_THAT(Left(scratch()), IsEmpty());
  EXPECT_THAT(Left(out()), IsEmpty());
}

TEST_F(DemoTest, WhenItIsKilledItsProcessesDieWithIt) {
  ChildProcess demo = StartDemo();
  ASSERT_TRUE(test::WaitUntil([&] { return Fleet().size() == 5; })) << Contents(log());
  const std::vector<pid_t> demos = ProcessesOf(out(), "trailcast");
  ASSERT_EQ(demos.size(), 1U);
  ASSERT_EQ(kill(demos.front(), SIGKILL), 0);
  EXPECT_TRUE(test::WaitUntil([&] { return Fleet().empty(); }));
}

TEST_F(DemoTest, WhenTheServerDiesItSaysSoAndEnds) {
  ChildProcess demo = StartDemo();
  ASSERT_TRUE(test::WaitUntil([&] { return Fleet().size() == 5; })) << Contents(log());
  const std::vector<pid_t> servers = ProcessesOf(scratch(), "trailcast-server");
  ASSERT_EQ(servers.size(), 1U);
  ASSERT_EQ(kill(servers.front(), SIGKILL), 0);
  ASSERT_TRUE(test::WaitUntil([&] { return demo.Poll().has_value(); })) << Contents(log());
  EXPECT_EQ(demo.Poll()->code, 1);
  EXPECT_THAT(Contents(log()), HasSubstr("the route server ended by signal 9"));
  EXPECT_THAT(Fleet(), IsEmpty());
  EXPECT_THAT(Left(scratch()), IsEmpty());
}

// Returns what the console says of one of the robots.
std::string StateOf(const std::string& robot, httplib::Client& client) {
  const auto got = client.Get("/api/state");
  const auto state = got ? nlohmann::json::parse(got->body, nullptr, false) : nlohmann::json();
  for (const auto& each : state.value("robots", nlohmann::json::array())) {
    if (each.value("name", "") == robot) return each.value("state", "");
  }
  return "";
}

TEST_F(DemoTest, WithAConsoleRobotsOnDutyDriveUntilItIsInterrupted) {
  ChildProcess demo = StartDemo({"--console", "--http-port", "0"});
  const std::string said = "open http://localhost:";
  ASSERT_TRUE(test::WaitUntil([&] { return Contents(log()).find(said) != std::string::npos; }))
      << Contents(log());
  const std::string text = Contents(log());
  httplib::Client client("localhost", std::stoi(text.substr(text.find(said) + said.size())));
  for (const char* robot : {"robot-1", "robot-2"}) {
    EXPECT_TRUE(test::WaitUntil([&] { return StateOf(robot, client) == "driving"; }, seconds(200)))
        << robot << Contents(log());
  }
  EXPECT_EQ(StateOf("robot-3", client), "available");
  const std::vector<pid_t> demos = ProcessesOf(out(), "trailcast");
  ASSERT_EQ(demos.size(), 1U);
  ASSERT_EQ(kill(demos.front(), SIGINT), 0);
  ASSERT_TRUE(test::WaitUntil([&] { return demo.Poll().has_value(); })) << Contents(log());
  EXPECT_TRUE(demo.Poll()->ok()) << Contents(log());
  EXPECT_FALSE(client.Get("/api/state"));
  EXPECT_THAT(Fleet(), IsEmpty());
  EXPECT_THAT(Left(scratch()), IsEmpty());
}

TEST_F(DemoTest, WhereTheConsolesPortIsTakenItSaysSoAndEnds) {
  httplib::Server other;
  const int port = other.bind_to_any_port("127.0.0.1");
  ASSERT_GT(port, 0);
  ChildProcess demo = StartDemo({"--console", "--http-port", std::to_string(port)});
  ASSERT_TRUE(test::WaitUntil([&] { return demo.Poll().has_value(); })) << Contents(log());
  EXPECT_EQ(demo.Poll()->code, 1);
  EXPECT_THAT(Contents(log()), HasSubstr("is the port taken"));
  EXPECT_THAT(Contents(log()), HasSubstr("--http-port"));
  EXPECT_THAT(Fleet(), IsEmpty());
}

TEST_F(DemoTest, AskingForRoutesWhereThereIsNoServerFailsAndSaysWhy) {
  auto routes = ChildProcess::Start(
      {(kPrograms / "trailcast").string(), "routes", "--timeout", "0.5", "--network-interface",
       "lo", "--dds-tag", "nobody-" + scratch().parent_path().filename().string()},
      log());
  ASSERT_TRUE(routes.has_value());
  ASSERT_TRUE(test::WaitUntil([&] { return routes->Poll().has_value(); }));
  EXPECT_EQ(routes->Poll()->code, 1);
  EXPECT_THAT(Contents(log()), HasSubstr("no route server answered"));
}

}  // namespace
}  // namespace trailcast::demo
