#pragma once

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <fstream>
#include <map>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "tests/scenario/lab/taught_once.h"
#include "tests/scenario/programs.h"
#include "tests/support/await.h"

namespace trailcast::test {

// These are virtual robots in the laboratory, and agents that drive them over ROS 2's topics.
// Robots and agents have a ROS domain of their own.
class RobotsTest : public ProgramsTest {
 protected:
  // These are where a robot stands, and the path that a scout is driven along.
  static constexpr const char* kPath = "1,1.5\n4.5,1.5\n";

  std::unique_ptr<Process> BeginRobot(const std::string& name, const Words& words,
                                      const std::string& path = kPath) {
    const std::string file = Path(name + "-path.csv");
    std::ofstream(file) << "x_m,y_m\n" << path;
    const bool has_camera = std::find(words.begin(), words.end(), "--camera") != words.end();
    return Start("trailcast",
                 With(With({"robot", "--sim", "indoor", "--path", file, "--ros2", "/" + name,
                            "--ros-domain", "3", "--ros-dds-tag", tag_},
                           has_camera ? Words{} : Words{"--camera", kSmallPictures}),
                      words),
                 name);
  }
  std::unique_ptr<Process> Robot(const std::string& name, const Words& words,
                                 const std::string& path = kPath) {
    auto robot = BeginRobot(name, words, path);
    // An agent that hears nothing for ten seconds gives the robot up.
    EXPECT_TRUE(robot->WaitForOutput("/image_raw, in ")) << robot->output();
    return robot;
  }
  [[nodiscard]] Words Drives(const std::string& robot) const {
    return {"--ros2", "/" + robot, "--ros-domain", "3", "--ros-dds-tag", tag_};
  }
  // Returns how far east a driving robot is: the last place of its truth that is written whole.
  double Along_m(const std::string& truth) {
    std::ifstream in(Path(truth));
    std::optional<double> x_m;
    for (std::string line; std::getline(in, line) && !in.eof();) {
      const auto first = line.find(',');
      if (first != std::string::npos && line[0] != 't') x_m = std::stod(line.substr(first + 1));
    }
    EXPECT_TRUE(x_m) << truth << " has no place";
    return x_m.value_or(-1.0);
  }
  // Waits until the robot stays where it is for a second. Returns false if it does not within ten.
  bool Stands(const std::string& truth) {
    using std::chrono::steady_clock;
    const auto deadline = steady_clock::now() + test::kLongEnough;
    double at_m = Along_m(truth);
    auto since = steady_clock::now();
    while (steady_clock::now() < deadline) {
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
      if (const double now_m = Along_m(truth); std::abs(now_m - at_m) > 0.01) {
        at_m = now_m;
        since = steady_clock::now();
      }
      if (steady_clock::now() - since > std::chrono::seconds(1)) return true;
    }
    return false;
  }
  // The robot drives half as fast as it could, so that a tool that starts late on a busy machine
  // finds it on its way.
  static constexpr const char* kUnhurried_mps = "0.25";
  // This is for robots that no tool has to find on their way.
  static constexpr const char* kUnwatched_mps = "0.5";
  // Starts a robot's agent, which waits to be sent; the store has its routes.
  std::unique_ptr<Process> Serve(const std::string& robot, const std::string& log = "duty",
                                 const Words& more = {}, const std::string& store = "routes.db") {
    return Agent(With(With({"serve", "--store", Path(store), "--name", robot, "--max-speed",
                            most_mps_, "--battery-topic", "battery_state"},
                           Drives(robot)),
                      more),
                 log);
  }
  // The first test that asks for it has it taught, and those after it have a copy of the store.
  void Teach(const std::string& store = "routes.db", const std::string& path = kPath,
             const std::string& route = "hall") {
    std::string& what = taught_[store];
    what += route + "\n" + path;
    const TaughtOnce once(what);
    if (once.CopyTo(Path(store))) return;
    const auto robot = Robot("scout", {"--scout", "--lockstep"}, path);
    const auto scout =
        RunAgent(With(With({"teach", "--route", route, "--store", Path(store)}, Drives("scout")),
                      {"--lockstep", "--end-when-still", "1"}));
    ASSERT_EQ(scout.status, 0) << scout.output << robot->output();
    once.Keep(Path(store));
  }
  // Returns the agent of a robot.
  std::unique_ptr<Process> Follow(const std::string& robot, const std::string& store,
                                  const Words& words, const std::string& log = "follower") {
    return Agent(
        With(With({"replay", "--route", "hall", "--store", Path(store)}, Drives(robot)), words),
        log);
  }
  std::unique_ptr<Process> Follow(const Words& words) {
    return Follow("robot1", "routes.db", words);
  }
  struct Place {
    double x_m = 0.0;
    double y_m = 0.0;
  };
  // Returns where the robot was at each step, by its truth.
  std::vector<Place> TruePlaces() {
    std::ifstream in(Path("truth.csv"));
    std::string line;
    std::getline(in, line);
    std::vector<Place> places;
    while (std::getline(in, line)) {
      std::replace(line.begin(), line.end(), ',', ' ');
      std::istringstream words(line);
      double t_s = 0.0;
      Place& place = places.emplace_back();
      words >> t_s >> place.x_m >> place.y_m;
    }
    return places;
  }
  // Ends the robot, whose truth must say that it has come to the end of kPath.
  void EndAtThePathsEnd(Process& robot) {
    robot.Signal(SIGTERM);
    ASSERT_EQ(End(robot).status, 0) << robot.output();
    const auto places = TruePlaces();
    ASSERT_FALSE(places.empty());
    EXPECT_NEAR(places.back().x_m, 4.5, 0.4);
    EXPECT_NEAR(places.back().y_m, 1.5, 0.25);
  }
  static double Number(const std::string& text, const std::string& key) {
    const auto at = text.find(key + "=");
    double value = -1.0;
    if (at != std::string::npos) {
      std::from_chars(text.data() + at + key.size() + 1, text.data() + text.size(), value);
    }
    return value;
  }

  const char* most_mps_ = kUnhurried_mps;  // of robots that Serve starts

 private:
  std::map<std::string, std::string> taught_;  // by its store
};

}  // namespace trailcast::test
