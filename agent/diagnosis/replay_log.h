#pragma once

#include <filesystem>
#include <vector>

#include "agent/session/replay_session.h"
#include "services/base/time.h"

namespace trailcast::agent {

// Keeps the decisions of all frames in memory, because the control loop touches no disk.
class ReplayLog {
 public:
  void Add(SensorTime stamp, const ReplayStep& step, double cpu_ms);

  [[nodiscard]] std::size_t frames() const { return rows_.size(); }
  // Returns the CPU time of a step, or 0 without frames.
  [[nodiscard]] double MedianMs() const;
  // Writes frame,segment,progress,features,turn_rad,state and more; see docs/reference/agent.md.
  [[nodiscard]] Result<void> WriteCsv(const std::filesystem::path& file) const;

 private:
  struct Row {
    SensorTime stamp{0};
    std::uint32_t segment = 0;
    double progress = 0.0;
    int features = 0;
    double turn_rad = 0.0;
    ReplayState state = ReplayState::kWaiting;
    double fraction = 0.0;
    motion::VelocityCommand command;
    double cpu_ms = 0.0;
  };
  std::vector<Row> rows_;
};

}  // namespace trailcast::agent
