// Runs that nobody here recorded: taught on one, replayed on the other, open loop, by vision alone.
// What must hold is in ../shared/data/README.md; skipped, visibly, where that data is absent.

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>

#include "tests/scenario/programs.h"

namespace trailcast::test {
namespace {

using testing::HasSubstr;

struct Frame {
  int segment = 0;
  double turn_rad = 0.0;
  std::string state;
};

class RecordedRunsTest : public ProgramsTest {
 protected:
  static std::filesystem::path Data(const std::string& name) {
    return std::filesystem::path(TRAILCAST_SOURCE_DIR) / ".." / "shared" / "data" / name;
  }
  static bool Absent(const std::string& name) { return !std::filesystem::is_directory(Data(name)); }

  // One CSV row a frame, in the contract's columns.
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
  Replayed TeachAndReplay(const std::filesystem::path& teach, const std::filesystem::path& replay) {
    const auto taught = RunAgent({"teach", "--frames", teach.string(), "--route", "run", "--store",
                                  Path("route.db"), "--report", Path("taught.txt")});
    EXPECT_EQ(taught.status, 0) << taught.output;
    EXPECT_THAT(taught.output, HasSubstr("no odometry"));
    const auto seen = RunAgent({"replay", "--frames", replay.string(), "--route", "run", "--store",
                                Path("route.db"), "--csv", Path("out.csv")});
    EXPECT_TRUE(seen.status == 0 || seen.status == 3) << seen.output;
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

std::map<int, double> ReadSteering(const std::filesystem::path& file) {
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

TEST_F(RecordedRunsTest, DonkeyTrackGoesRoundAndTurnsAsItsDriverDid) {
  if (Absent("donkey_track")) GTEST_SKIP() << "no recorded runs at " << Data("donkey_track");
  const Replayed run =
      TeachAndReplay(Data("donkey_track") / "teach", Data("donkey_track") / "replay");
  ASSERT_GT(run.frames.size(), 400U);

  int furthest = 0;
  for (const Frame& frame : run.frames) {
    EXPECT_GE(frame.segment, furthest - 1) << "progress went back more than one segment";
    furthest = std::max(furthest, frame.segment);
  }
  EXPECT_EQ(furthest, run.segments - 1) << "the end was not reached";

  // Steering above 0 is to the right and leads the image by 2 to 5 frames; counted while following.
  const auto steering = ReadSteering(Data("donkey_track") / "replay_steering.csv");
  for (const int lead : {2, 3, 4, 5}) {
    int asked = 0;
    int agreed = 0;
    for (int i = lead; i < static_cast<int>(run.frames.size()); ++i) {
      const Frame& frame = run.frames[static_cast<std::size_t>(i)];
      const auto steered = steering.find(i - lead);
      if (steered == steering.end() || std::abs(steered->second) <= 0.3) continue;
      if (frame.state == "ARRIVED") continue;
      ++asked;
      agreed += steered->second * frame.turn_rad > 0.0 ? 1 : 0;
    }
    ASSERT_GT(asked, 150);
    EXPECT_GE(agreed, 0.85 * asked) << agreed << " of " << asked << " at a lead of " << lead;
  }
}

// How many frames ask for a turn to the right, and how many to the left.
std::pair<int, int> RightAndLeft(const std::vector<Frame>& frames) {
  const auto right = std::count_if(frames.begin(), frames.end(),
                                   [](const Frame& frame) { return frame.turn_rad > 0.0; });
  const auto left = std::count_if(frames.begin(), frames.end(),
                                  [](const Frame& frame) { return frame.turn_rad < 0.0; });
  return {static_cast<int>(right), static_cast<int>(left)};
}

TEST_F(RecordedRunsTest, CorridorWalkedOnTheLeftAsksForRight) {
  if (Absent("corridor_offset")) GTEST_SKIP() << "no recorded runs at " << Data("corridor_offset");
  const auto [right, left] = RightAndLeft(
      TeachAndReplay(Data("corridor_offset") / "ref", Data("corridor_offset") / "query").frames);
  EXPECT_GT(right, left);
  EXPECT_GE(right + left, 30);
}

TEST_F(RecordedRunsTest, CorridorWalkedOnTheRightAsksForLeft) {
  if (Absent("corridor_offset")) GTEST_SKIP() << "no recorded runs at " << Data("corridor_offset");
  const auto [right, left] = RightAndLeft(
      TeachAndReplay(Data("corridor_offset") / "query", Data("corridor_offset") / "ref").frames);
  EXPECT_GT(left, right);
  EXPECT_GE(right + left, 30);
}

TEST_F(RecordedRunsTest, ARecordedRunTeachesTheServerLikeAnyScout) {
  if (Absent("donkey_track")) GTEST_SKIP() << "no recorded runs at " << Data("donkey_track");
  const auto server = Server();
  const auto scout = RunAgent({"teach", "--frames", (Data("donkey_track") / "teach").string(),
                               "--route", "lap", "--store", Path("scout.db"), "--server"});
  EXPECT_EQ(scout.status, 0) << scout.output;
  EXPECT_THAT(scout.output, HasSubstr("unreceipted=0"));
  const auto follower = RunAgent({"replay", "--frames", (Data("donkey_track") / "replay").string(),
                                  "--route", "lap", "--store", Path("follower.db"), "--server"});
  EXPECT_EQ(follower.status, 0) << follower.output;
}

}  // namespace
}  // namespace trailcast::test
