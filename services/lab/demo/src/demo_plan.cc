#include "services/lab/demo/demo_plan.h"

#include <fmt/format.h>

#include <fstream>
#include <iterator>
#include <utility>

#include "services/lab/sim/core/random.h"

namespace trailcast::demo {
namespace {

// The path goes from one room to the other and back, with a turn on the spot at both ends.
constexpr const char* kRound =
    "x_m,y_m\n2.6,1.5\n6,1.5\n7.2,3.2\n7.2,5.6\n7.2,3.2\n6,1.5\n2,1.5\n2.6,1.5\n";

// This is the scout's kind of camera on another robot: higher up, and looking a little aside and
// up.
constexpr const char* kOtherMount = "webcam+height_m=0.42+yaw_deg=2+pitch_deg=2";

// The paths of three scouts through the laboratory, which come together before the doorway: the
// first comes from the west; the second begins beside it and then goes round by the east; the third
// comes from the east.
struct TaughtWay {
  const char* route;
  const char* path;
  const char* camera;
  const char* camera_word;
  // Robots may stand on these metres straight ahead of the first way-point.
  double x_m, y_m, towards_x;
  double straight_m;
};
constexpr TaughtWay kWays[] = {
    {"hall", "x_m,y_m\n1,1.5\n6,1.5\n7.2,3.2\n7.2,5.6\n6,7\n2.3,7\n", "webcam", "webcam", 1.0, 1.5,
     1.0, 1.6},
    {"round", "x_m,y_m\n2,1.5\n8,1.5\n8.5,2.3\n7.3,3.9\n7.2,5.6\n6,7\n3.5,7\n", "webcam, moved",
     kOtherMount, 2.0, 1.5, 1.0, 1.0},
    {"east", "x_m,y_m\n11.2,1.6\n8.6,1.6\n7.2,3.3\n7.2,5.6\n6,7\n3.5,7\n", "webcam, 70 deg",
     "webcam+hfov_deg=70", 11.2, 1.6, -1.0, 1.0},
};
// The places, with headings in degrees, where a robot that was taken up may be set down: far along
// the common path, off every path, and near the beginning of two.
constexpr const char* kSetDown[] = {"4.6,7,180", "9.5,7.9,200", "3.5,1.5,0"};
// A robot's camera, and the path on which it begins.
struct Goes {
  const char* camera;
  const char* camera_word;
  std::size_t way;
};
constexpr Goes kGoing[] = {{"webcam, moved", kOtherMount, 0},
                           {"webcam, 45 deg", "webcam+hfov_deg=45", 0},
                           {"wide", "wide", 2},
                           {"webcam, 50 deg", "webcam+hfov_deg=50", 1},
                           {"webcam", "webcam", 2}};

Result<void> WriteText(const std::filesystem::path& file, const char* text) {
  std::ofstream out(file);
  out << text;
  out.close();
  if (!out) return Fail(ErrorCode::kUnavailable, "cannot write {}", file.string());
  return {};
}

DemoRobot MakeRobot(const std::filesystem::path& folder, std::uint64_t seed,
                    const std::string& name, DemoRobot::Task does, const std::string& camera,
                    const std::string& camera_word) {
  DemoRobot robot;
  robot.name = name;
  robot.camera = camera;
  robot.camera_word = camera_word;
  robot.task = does;
  // It has 63 bits, which a TOML file or another program can hold as well.
  robot.seed = sim::Random(seed, name).Bits() >> 1U;
  robot.truth = folder / (name + "-truth.csv");
  robot.report = folder / (name + "-report.txt");
  return robot;
}

// Plans the scout, and robots with other cameras.
std::vector<DemoRobot> PlanSwarm(const std::filesystem::path& folder, std::uint64_t seed,
                                 const std::string& prefix, DemoRobot::Task task) {
  const auto plan = [&](const std::string& name, DemoRobot::Task does, const std::string& camera,
                        const std::string& word) {
    return MakeRobot(folder, seed, name, does, camera, word);
  };
  return std::vector<DemoRobot>{plan("scout", DemoRobot::Task::kTeach, "webcam", "webcam"),
                                plan(prefix + "1", task, "webcam, moved", kOtherMount),
                                plan(prefix + "2", task, "firewire", "firewire"),
                                plan(prefix + "3", task, "wide", "wide")};
}

}  // namespace

std::vector<DemoRobot> PlanRobots(const std::filesystem::path& folder, std::uint64_t seed) {
  return PlanSwarm(folder, seed, "follower-", DemoRobot::Task::kFollow);
}

Result<std::vector<DemoRobot>> PlanDuty(const std::filesystem::path& folder, std::uint64_t seed) {
  const std::filesystem::path round = folder / "round.csv";
  if (auto written = WriteText(round, kRound); !written) return tl::unexpected(written.error());
  auto robots = PlanSwarm(folder, seed, "robot-", DemoRobot::Task::kOnDuty);
  for (DemoRobot& robot : robots) {
    robot.route = kRoundRoute;
    robot.path = round;
  }
  return robots;
}

Result<NetworkPlan> PlanNetwork(const std::filesystem::path& folder, std::uint64_t seed) {
  NetworkPlan plan;
  for (const TaughtWay& way : kWays) {
    DemoRobot scout = MakeRobot(folder, seed, fmt::format("scout-{}", plan.robots.size() + 1),
                                DemoRobot::Task::kTeach, way.camera, way.camera_word);
    scout.route = way.route;
    scout.path = folder / fmt::format("{}.csv", way.route);
    if (auto written = WriteText(scout.path, way.path); !written) {
      return tl::unexpected(written.error());
    }
    plan.robots.push_back(std::move(scout));
  }
  for (const Goes& goes : kGoing) {
    const TaughtWay& way = kWays[goes.way];
    DemoRobot robot = MakeRobot(folder, seed, fmt::format("robot-{}", plan.journeys.size() + 1),
                                DemoRobot::Task::kOnDuty, goes.camera, goes.camera_word);
    // Rounded to what people tell by eye.
    const double along_m =
        0.1 * static_cast<int>(
                  10.0 * sim::Random(seed, robot.name + " stands").Uniform(0.0, way.straight_m));
    robot.route = way.route;
    robot.path = folder / (robot.name + ".csv");
    const double x_m = way.x_m + way.towards_x * along_m;
    const std::string ahead =
        fmt::format("x_m,y_m\n{0},{1}\n{2},{1}\n", x_m, way.y_m, x_m + way.towards_x);
    if (auto written = WriteText(robot.path, ahead.c_str()); !written) {
      return tl::unexpected(written.error());
    }
    plan.journeys.push_back({plan.robots.size(), fmt::format("{}@{:.1f}", way.route, along_m)});
    plan.robots.push_back(std::move(robot));
  }
  sim::Random carry(seed, "carry");
  const int who = carry.Integer(0, static_cast<int>(plan.journeys.size()) - 1);
  const int where = carry.Integer(0, static_cast<int>(std::size(kSetDown)) - 1);
  plan.robots[plan.journeys[static_cast<std::size_t>(who)].robot].carry =
      fmt::format("{}@{:.1f}", kSetDown[where], carry.Uniform(2.0, 6.0));
  return plan;
}

}  // namespace trailcast::demo
