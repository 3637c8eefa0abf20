#pragma once

#include <fstream>
#include <memory>
#include <optional>
#include <string>

#include "tests/scenario/programs.h"

namespace trailcast::test {

// Virtual robots in the laboratory, and agents that drive them over ROS 2's topics. Robots and
// agents have a ROS domain of their own.
class RobotsTest : public ProgramsTest {
 protected:
  // Where a robot stands, and the path that a scout is driven along.
  static constexpr const char* kPath = "1,1.5\n4.5,1.5\n";

  std::unique_ptr<Process> Robot(const std::string& name, const Words& words,
                                 const std::string& path = kPath) {
    const std::string file = Path(name + "-path.csv");
    std::ofstream(file) << "x_m,y_m\n" << path;
    return Start("trailcast",
                 With({"robot", "--sim", "indoor", "--path", file, "--ros2", "/" + name,
                       "--ros-domain", "3", "--ros-dds-tag", tag_},
                      words),
                 name);
  }
  [[nodiscard]] Words Drives(const std::string& robot) const {
    return {"--ros2", "/" + robot, "--ros-domain", "3", "--ros-dds-tag", tag_};
  }
  // How far east a robot is that drives now: the last place of its truth that is written whole.
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
  // Route 'hall', into this store.
  void Teach(const std::string& store = "routes.db", const std::string& path = kPath) {
    const auto robot = Robot("scout", {"--scout", "--lockstep"}, path);
    const auto scout =
        RunAgent(With(With({"teach", "--route", "hall", "--store", Path(store)}, Drives("scout")),
                      {"--lockstep", "--end-when-still", "1"}));
    ASSERT_EQ(scout.status, 0) << scout.output << robot->output();
  }
  // The agent of a robot.
  std::unique_ptr<Process> Follow(const std::string& robot, const std::string& store,
                                  const Words& words, const std::string& log = "follower") {
    return Agent(
        With(With({"replay", "--route", "hall", "--store", Path(store)}, Drives(robot)), words),
        log);
  }
};

}  // namespace trailcast::test
