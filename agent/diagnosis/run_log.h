#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "agent/session/evidence.h"

namespace trailcast::agent {

// These are the values of a replay's log; idl/run_log.proto has the messages of its file.

// The robot's activity in a frame: ReplayState and Trust in one word.
enum class Phase {
  kWaiting,
  kSeeking,
  kSure,
  kUnsure,
  kDistant,
  kBlind,
  kCovered,
  kArrived,
  kLost,
  kLooking
};

[[nodiscard]] const char* ToString(Phase phase);
[[nodiscard]] std::optional<Phase> ParsePhase(const std::string& word);

// Named values in the order in which they were added.
class Fields {
 public:
  void Add(std::string key, std::string value) {
    all_.emplace_back(std::move(key), std::move(value));
  }
  [[nodiscard]] std::optional<std::string> Find(const std::string& key) const;
  // Returns nothing if there is no such value, or it is no number.
  [[nodiscard]] std::optional<double> Number(const std::string& key) const;
  [[nodiscard]] const std::vector<std::pair<std::string, std::string>>& all() const { return all_; }

 private:
  std::vector<std::pair<std::string, std::string>> all_;
};

// One frame. A value is empty if the robot or the method does not have it.
struct FrameRow {
  int frame = 0;
  double t_s = 0.0;
  int segment = 0;
  double fraction = 0.0;  // of the segment
  double progress = 0.0;  // of the segment
  Phase phase = Phase::kWaiting;
  // Numbers of features: in the segment, followed, agreeing with the route, not agreeing and by how
  // much, and lost since the frame before.
  int stored = 0;
  int tracked = 0;
  int agreeing = 0;
  int rejected = 0;
  double rejected_by_px = 0.0;
  int left_picture = 0;
  int not_returned = 0;
  // The commanded turns, positive to the right.
  double turn_rad = 0.0;
  std::optional<double> vision_turn_rad;
  std::optional<double> odometry_turn_rad;
  std::optional<double> delta;
  std::optional<double> delta_minus;
  // The estimated offset from the path, positive to the left.
  std::optional<double> left_m;
  std::optional<double> left_sigma_m;
  std::optional<double> heading_rad;
  std::optional<double> along_m;
  std::optional<double> mount_yaw_rad;
  double magnification = 1.0;
  // By odometry, in its own frame.
  std::optional<double> driven_m;
  std::optional<double> x_m;
  std::optional<double> y_m;
  double linear_mps = 0.0;
  double angular_radps = 0.0;
  double cpu_ms = 0.0;
  std::optional<double> true_off_m;  // true distance from the taught path, in simulated trials
  // The most likely place by the belief over the whole route, as shares of the known part.
  std::optional<double> place;
  std::optional<double> place_sigma;
  std::optional<double> off_route;  // probability
  // These tell how far odometry is believed, 0 to 1, and how many of the route's metres each of its
  // own is.
  std::optional<double> odometry_trust;
  std::optional<double> odometry_scale;
  Evidence evidence = Evidence::kNothing;
};

struct RunEvent {
  int frame = 0;
  double t_s = 0.0;
  std::string what{};
  Fields fields{};
  std::string text{};  // for people; may be empty
};

// Describes what happened in one line, without the frame and the time.
[[nodiscard]] std::string DescribeEvent(const RunEvent& event);

struct RunLog {
  Fields header;
  std::vector<FrameRow> frames;
  std::vector<RunEvent> events;
  std::vector<std::string> damage;  // the first of what could not be read
  std::size_t damaged = 0;          // how much could not be read
  std::optional<RunEvent> ending;   // nothing if the log breaks off
};

}  // namespace trailcast::agent
