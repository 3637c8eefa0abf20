#include "agent/diagnosis/replay_log.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "services/base/text_file.h"

namespace trailcast::agent {

void ReplayLog::Add(SensorTime stamp, const ReplayStep& step, double cpu_ms) {
  rows_.push_back({stamp, step.segment.value(), step.progress, step.features, step.turn_rad,
                   step.state, step.fraction, step.command, cpu_ms});
}

double ReplayLog::MedianMs() const {
  if (rows_.empty()) return 0.0;
  std::vector<double> times;
  for (const Row& row : rows_) times.push_back(row.cpu_ms);
  const auto middle = times.begin() + std::ssize(times) / 2;
  std::nth_element(times.begin(), middle, times.end());
  return *middle;
}

Result<void> ReplayLog::WriteCsv(const std::filesystem::path& file) const {
  std::string text =
      "frame,segment,progress,features,turn_rad,state,t_s,fraction,linear_mps,angular_radps\n";
  int frame = 0;
  for (const Row& row : rows_) {
    fmt::format_to(
        std::back_inserter(text), "{},{},{:.5f},{},{:.5f},{},{:.4f},{:.4f},{:.4f},{:.4f}\n",
        frame++, row.segment, row.progress, row.features, row.turn_rad, ToString(row.state),
        Seconds(row.stamp), row.fraction, row.command.linear_mps, row.command.angular_radps);
  }
  return WriteTextFile(file, text);
}

}  // namespace trailcast::agent
