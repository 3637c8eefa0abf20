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
// Of robots on duty: it ends where it begins, so that they can be sent again and again.
inline constexpr const char* kRoundRoute = "round";

// One robot of the demo: what it is, and where its process leaves what it knows.
struct DemoRobot {
  enum class Task { kTeach, kFollow, kOnDuty };
  std::string name;
  std::string camera;       // for people
  std::string camera_word;  // for trailcast-agent: a built-in one or a camera file
  std::uint64_t seed = 0;
  Task task = Task::kFollow;
  std::string route = kDemoRoute;  // that it teaches or follows
  std::filesystem::path path;      // way-points; empty: the world's own
  std::filesystem::path truth;     // CSV of true poses, written at the end
  std::filesystem::path report;    // key=value lines, written at the end
  std::string carry{};             // as --sim-carry takes it; empty: nobody carries it off

  [[nodiscard]] bool is_scout() const { return task == Task::kTeach; }
};

// The scout first, then the followers; files in `folder`.
[[nodiscard]] std::vector<DemoRobot> PlanRobots(const std::filesystem::path& folder,
                                                std::uint64_t seed);
// The scout of kRoundRoute first, then robots on duty at its beginning.
[[nodiscard]] Result<std::vector<DemoRobot>> PlanDuty(const std::filesystem::path& folder,
                                                      std::uint64_t seed);

// Routes of three scouts with other cameras, which come to one place over the same metres; robots
// on duty stand somewhere along them, and one is carried off under way, drawn from the seed.
struct NetworkPlan {
  struct Journey {
    std::size_t robot = 0;  // of `robots`
    std::string from;       // where it stands: "hall@1.2"
  };
  std::vector<DemoRobot> robots;  // the scouts first
  std::vector<Journey> journeys;
  // Along the first scout's route: where all are sent, and what is closed while they drive. No
  // other route comes near that.
  double goal_m = 14.5;
  double closed_from_m = 5.5;
  double closed_to_m = 6.5;
};
[[nodiscard]] Result<NetworkPlan> PlanNetwork(const std::filesystem::path& folder,
                                              std::uint64_t seed);

}  // namespace trailcast::demo
