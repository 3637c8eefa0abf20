#include "agent/device/src/time_in.h"

#include <cmath>

namespace trailcast::agent {
namespace {

constexpr double kLongest_s = 100.0 * 365.25 * 24.0 * 3600.0;

}  // namespace

Result<SensorTime> TimeIn(const NumberRow& row, const std::filesystem::path& file) {
  const double time_s = row.cells[0];
  if (std::abs(time_s) > kLongest_s) {
    return Fail(ErrorCode::kInvalidArgument,
                "{}, line {}: time {} s is no time of any clock: expected seconds, a hundred years "
                "of them at most",
                file.string(), row.line, time_s);
  }
  return FromSeconds(time_s);
}

}  // namespace trailcast::agent
