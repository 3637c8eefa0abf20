#pragma once

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <optional>
#include <sstream>

#include "tests/scenario/programs.h"
#include "tests/support/places.h"
#include "tests/support/recorded/record_through.h"

namespace trailcast::test {

struct Frame {
  int segment = 0;
  double turn_rad = 0.0;
  std::string state;
};

class RecordedRunsTest : public ProgramsTest {
 protected:
  static std::filesystem::path Data(const std::string& name) {
    return std::filesystem::path(SourceDir()) / ".." / "shared" / "data" / name;
  }
  static bool Absent(const std::string& name) { return !std::filesystem::is_directory(Data(name)); }

  // These are CSV rows, one for each frame, in the contract's columns.
  static std::vector<Frame> ReadCsv(const std::string& file) {
    std::ifstream stream(file);
    std::string line;
    std::getline(stream, line);
    EXPECT_EQ(line.rfind("frame,segment,progress,features,turn_rad,state", 0), 0U) << line;
    std::vector<Frame> frames;
    while (std::getline(stream, line)) {
      std::vector<std::string> fields;
      std::istringstream row(line);
      for (std::string field; std::getline(row, field, ',');) fields.push_back(field);
      frames.push_back({std::stoi(fields.at(1)), std::stod(fields.at(4)), fields.at(5)});
    }
    return frames;
  }

  struct Replayed {
    std::vector<Frame> frames;
    int segments = 0;  // of the route
  };
  // `camera` is the follower's, if it is not the one that recorded the run.
  Replayed TeachAndReplay(const std::filesystem::path& teach, const std::filesystem::path& replay,
                          const std::optional<trial::OtherCamera>& camera = {}) {
    const auto taught = RunAgent({"teach", "--frames", teach.string(), "--route", "run", "--store",
                                  Path("route.db"), "--report", Path("taught.txt")});
    EXPECT_EQ(taught.status, 0) << taught.output;
    EXPECT_THAT(taught.output, testing::HasSubstr("no odometry"));
    std::filesystem::path frames = replay;
    if (camera) RecordThrough(*camera, replay, frames = Path("second"));
    const auto replaying = Agent({"replay", "--frames", frames.string(), "--route", "run",
                                  "--store", Path("route.db"), "--csv", Path("out.csv")});
    // Searching far and wide in larger pictures takes half a minute on a machine of its own.
    const int status = replaying->Wait(std::chrono::seconds(500)).value_or(-1);
    EXPECT_TRUE(status == 0 || status == 3) << status << ": " << replaying->output();
    return {ReadCsv(Path("out.csv")), Reported("taught.txt", "segments")};
  }
  int Reported(const std::string& file, const std::string& key) {
    std::ifstream stream(Path(file));
    for (std::string line; std::getline(stream, line);) {
      if (line.rfind(key + "=", 0) == 0) return std::stoi(line.substr(key.size() + 1));
    }
    ADD_FAILURE() << "no " << key << " in " << file;
    return 0;
  }
};

inline std::map<int, double> ReadSteering(const std::filesystem::path& file) {
  std::ifstream stream(file);
  std::string line;
  std::getline(stream, line);  // frame,steering,throttle
  std::map<int, double> steering;
  while (std::getline(stream, line)) {
    const auto comma = line.find(',');
    steering[std::stoi(line)] = std::stod(line.substr(comma + 1));
  }
  return steering;
}

// Returns how many frames ask for a turn to the right, and how many to the left.
inline std::pair<int, int> RightAndLeft(const std::vector<Frame>& frames) {
  const auto right = std::count_if(frames.begin(), frames.end(),
                                   [](const Frame& frame) { return frame.turn_rad > 0.0; });
  const auto left = std::count_if(frames.begin(), frames.end(),
                                  [](const Frame& frame) { return frame.turn_rad < 0.0; });
  return {static_cast<int>(right), static_cast<int>(left)};
}

inline int FurthestSegment(const std::vector<Frame>& frames) {
  int furthest = 0;
  for (const Frame& frame : frames) furthest = std::max(furthest, frame.segment);
  return furthest;
}

// Returns how many frames ask for a turn to the side that the driver steered to, out of how many
// that steered clearly. Steering above 0 is to the right and leads the image.
struct Steered {
  int agreed = 0;
  int asked = 0;
};
inline Steered AgreementWithDriver(const std::vector<Frame>& frames,
                                   const std::map<int, double>& steering, int lead) {
  Steered count;
  for (int i = lead; i < static_cast<int>(frames.size()); ++i) {
    const Frame& frame = frames[static_cast<std::size_t>(i)];
    const auto steered = steering.find(i - lead);
    if (steered == steering.end() || std::abs(steered->second) <= 0.3) continue;
    if (frame.state == "ARRIVED") continue;
    ++count.asked;
    count.agreed += steered->second * frame.turn_rad > 0.0 ? 1 : 0;
  }
  return count;
}

}  // namespace trailcast::test
