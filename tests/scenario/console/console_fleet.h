#pragma once

#include <httplib.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "tests/scenario/robots.h"
#include "tests/support/await.h"
#include "tests/support/described.h"
#include "tests/support/places.h"

namespace trailcast::test {

// Returns on which port a console that starts says that it listens, or 0, and a failure, if it does
// not.
inline int ConsolesPort(Process& console) {
  const std::string said = "://localhost:";
  const bool listens = console.WaitForOutput(said);
  const std::string output = console.output();
  EXPECT_TRUE(listens) << output;
  return listens ? std::stoi(output.substr(output.find(said) + said.size())) : 0;
}

// Returns where a picture of the page goes, for people to look at.
inline std::filesystem::path Shot(const std::string& name) {
  const auto shots = std::filesystem::path(ProgramsDir()).parent_path() / "console";
  std::filesystem::create_directories(shots);
  return shots / (name + ".png");
}

// These are ten presses of the right arrow key, which are as good as a whole slide.
inline const std::string kSlide = [] {
  std::string right;
  for (int i = 0; i < 10; ++i) right += "\xEE\x80\x94";
  return right;
}();

// These are robots, and a console over HTTP.
class ConsoleFleetTest : public RobotsTest {
 protected:
  using json = nlohmann::json;

  void StartConsole(const Words& words = {}) {
    console_ = Start("trailcast-console", With({"--http-port", "0"}, words), "console");
    port_ = ConsolesPort(*console_);
    ASSERT_NE(port_, 0);
  }
  // The server has what was taught.
  bool Publish() {
    return RunAgent({"deliver", "--store", Path("routes.db"), "--name", "scout"}).status == 0;
  }
  void PutOnDuty(const Words& robot = {}) {
    robot_ = Robot("robot1", robot);
    agent_ = Serve("robot1");
    ASSERT_TRUE(agent_->WaitForOutput("available as 'robot1'")) << agent_->output();
  }
  [[nodiscard]] std::string Page() const {
    return "http://localhost:" + std::to_string(port_) + "/";
  }
  [[nodiscard]] httplib::Client Client() const {
    httplib::Client client("localhost", port_);
    client.set_read_timeout(test::kLongEnough);
    client.set_logger(console::ExpectAsDescribed());
    return client;
  }
  json Get(const std::string& path) {
    const auto got = Client().Get(path);
    return got ? json::parse(got->body, nullptr, false) : json();
  }
  struct Replied {
    int status = 0;
    json body{};
  };
  Replied Post(const std::string& path, const json& body = json::object()) {
    const auto got = Client().Post(path, body.dump(), "application/json");
    return got ? Replied{got->status, json::parse(got->body, nullptr, false)} : Replied{};
  }
  json State() { return Get("/api/state"); }
  json Robot1() {
    const json state = State();
    if (!state.is_object()) return json::object();
    for (const json& robot : state.value("robots", json::array())) {
      if (robot["name"] == "robot1") return robot;
    }
    return json::object();
  }
  bool WaitForState(const std::string& state) {
    return WaitUntil([&] { return Robot1().value("state", "") == state; });
  }

  std::unique_ptr<Process> server_;
  std::unique_ptr<Process> robot_;
  std::unique_ptr<Process> agent_;
  std::unique_ptr<Process> console_;
  int port_ = 0;
};

}  // namespace trailcast::test
