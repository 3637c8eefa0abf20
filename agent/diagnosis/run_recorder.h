#pragma once

#include <optional>
#include <string>
#include <vector>

#include "agent/diagnosis/run_log.h"
#include "agent/session/replay_session.h"
#include "services/base/time.h"
#include "services/motion/motion.h"
#include "services/route/route.h"

namespace trailcast::agent {

// The facts of the run that the log has before its first frame.
struct RunFacts {
  route::RouteInfo route;  // as far as it is known by then
  std::string robot;
  std::string camera;  // the robot's
  std::string method;
};

// One frame as the control loop saw it.
struct RunFrame {
  SensorTime stamp{0};
  std::optional<motion::Pose2> odometry;
  double cpu_ms = 0.0;
  std::optional<double> true_off_m;  // true distance from the taught path, in simulated trials
};

// A frame's row, and the events in it.
struct RecordedFrame {
  FrameRow row;
  std::vector<RunEvent> events;
};

// Makes the values of a replay's log from its steps, without a disk or a clock.
class RunRecorder {
 public:
  [[nodiscard]] static Fields Begin(const RunFacts& facts);
  [[nodiscard]] RecordedFrame Add(const RunFrame& frame, const ReplayStep& step);
  // Notes an event that only the control loop knows.
  [[nodiscard]] RunEvent Note(const std::string& what, const std::string& text) const;
  [[nodiscard]] RunEvent End(const std::string& state, const std::string& reason) const;

 private:
  [[nodiscard]] FrameRow RowOf(const RunFrame& frame, const ReplayStep& step) const;
  [[nodiscard]] RunEvent EventNow(const std::string& what) const;
  [[nodiscard]] RunEvent SearchEvent(const Search& search, double magnification) const;

  int frames_ = 0;
  double t_s_ = 0.0;
  double driven_m_ = 0.0;
  std::optional<motion::Pose2> odometry_;
  std::optional<Phase> phase_;
};

}  // namespace trailcast::agent
