#include "agent/device/src/recorded/time_in.h"

#include <cmath>
#include <utility>

#include "services/base/median.h"

namespace trailcast::agent {
namespace {

constexpr double kLongest_s = 100.0 * 365.25 * 24.0 * 3600.0;
// A moving robot's sensors give values more often, and fewer rows tell nothing.
constexpr double kLongestPace_s = 5.0;
constexpr std::size_t kFewRows = 10;

// Values come up to 200 times a second, and at least once in some seconds.
const char* UnitOf(double pace) {
  if (pace < 5e3) return "milliseconds";
  return pace < 5e6 ? "microseconds" : "nanoseconds";
}

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

Result<void> CheckPace(const std::vector<NumberRow>& rows, const std::filesystem::path& file) {
  if (rows.size() < kFewRows) return {};
  std::vector<double> paces_s;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    paces_s.push_back(rows[i].cells[0] - rows[i - 1].cells[0]);
  }
  const double pace_s = Median(std::move(paces_s));
  if (pace_s <= kLongestPace_s) return {};
  return Fail(ErrorCode::kInvalidArgument,
              "{}: by its times most rows are {:g} s apart, which is none of a drive: are they in "
              "{}? Expected seconds",
              file.string(), pace_s, UnitOf(pace_s));
}

}  // namespace trailcast::agent
