#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "services/base/result.h"

namespace trailcast::demo {

inline constexpr const char* kDemoRoute = "demo";
inline constexpr const char* kDemoWorld = "indoor";
// The route of robots that wait for missions. It ends where it begins, so that they can be sent
// again and again.
inline constexpr const char* kRoundRoute = "round";

// One robot of the demo, and where its process leaves its results.
struct DemoRobot {
  enum class Task { kTeach, kFollow, kOnDuty };
  std::string name;
  std::string camera;       // for people
  std::string camera_word;  // for trailcast-agent: a built-in one or a camera file
  std::uint64_t seed = 0;
  Task task = Task::kFollow;
  std::string route = kDemoRoute;  // the route that it teaches or follows
  std::filesystem::path path;      // way-points; empty for the world's own
  std::filesystem::path truth;     // CSV of true poses, written at the end
  std::filesystem::path report;    // key=value lines, written at the end
  std::string carry{};             // see --sim-carry; empty if nobody carries it off

  [[nodiscard]] bool is_scout() const { return task == Task::kTeach; }
};

// Plans the scout, which is the first, and the followers; files are in `folder`.
[[nodiscard]] std::vector<DemoRobot> PlanRobots(const std::filesystem::path& folder,
                                                std::uint64_t seed);
// Plans the scout of kRoundRoute, which is the first, and robots that wait for missions at the
// route's beginning.
[[nodiscard]] Result<std::vector<DemoRobot>> PlanDuty(const std::filesystem::path& folder,
                                                      std::uint64_t seed);

// The routes of three scouts with different cameras, which reach one place over the same metres.
// Robots that wait for missions stand somewhere along them, and one is carried off under way; the
// seed draws these.
struct NetworkPlan {
  struct Journey {
    std::size_t robot = 0;  // index in `robots`
    std::string from;       // where it stands: "hall@1.2"
  };
  std::vector<DemoRobot> robots;  // the scouts first
  std::vector<Journey> journeys;
  // These are metres along the first scout's route: the destination of all, and the section that is
  // closed while they drive. No other route comes near that section.
  double goal_m = 14.5;
  double closed_from_m = 5.5;
  double closed_to_m = 6.5;
};
[[nodiscard]] Result<NetworkPlan> PlanNetwork(const std::filesystem::path& folder,
                                              std::uint64_t seed);

}  // namespace trailcast::demo
