#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

#include "services/explain/src/incidents.h"
#include "services/explain/src/run_index.h"

namespace trailcast::explain {
namespace {

using agent::FrameRow;
using agent::Phase;
using agent::RunEvent;
using agent::RunLog;

constexpr int kManyLost = 6;
constexpr double kLargeShareLost = 0.35;
constexpr double kLargeShareRejected = 0.3;
constexpr int kManyRejected = 4;
constexpr double kFarBeside_m = 0.25;
constexpr double kFarInTruth_m = 0.3;
constexpr double kSlowShare = 0.75;
constexpr double kNotBelieved = 0.2;
constexpr std::size_t kShortest_frames = 5;

// Consecutive rows for which `holds`. `tell` describes them by their first, last and worst row.
struct Sections {
  std::string kind;
  double weight = 0.0;
  std::function<bool(std::size_t)> holds;
  std::function<double(const FrameRow&)> how_bad;
  std::function<std::string(const FrameRow& worst, std::size_t frames)> tell;
};

std::vector<Incident> Find(const RunLog& log, const Sections& what) {
  std::vector<Incident> incidents;
  for (std::size_t i = 0; i < log.frames.size(); ++i) {
    if (!what.holds(i)) continue;
    const std::size_t first = i;
    std::size_t worst = i;
    for (; i < log.frames.size() && what.holds(i); ++i) {
      if (what.how_bad(log.frames[i]) > what.how_bad(log.frames[worst])) worst = i;
    }
    if (i - first < kShortest_frames) continue;
    incidents.push_back(
        {what.kind, first, i - 1, what.weight, what.tell(log.frames[worst], i - first)});
  }
  return incidents;
}

bool Driving(const FrameRow& row) {
  return row.phase == Phase::kSure || row.phase == Phase::kUnsure || row.phase == Phase::kDistant;
}

Sections Disagreeing(const RunLog& log) {
  return {"disagree", 12.0,
          [&log](std::size_t i) {
            const FrameRow& row = log.frames[i];
            return Driving(row) && row.rejected >= kManyRejected &&
                   row.rejected >= kLargeShareRejected * row.tracked;
          },
          [](const FrameRow& row) { return static_cast<double>(row.rejected); },
          [](const FrameRow& row, std::size_t frames) {
            return fmt::format(
                "up to {} of {} features disagree with the route, by {:.0f} px ({} frames)",
                row.rejected, row.tracked, row.rejected_by_px, frames);
          }};
}

Sections Beside(const RunLog& log) {
  return {"beside", 15.0,
          [&log](std::size_t i) {
            const FrameRow& row = log.frames[i];
            return Driving(row) && std::abs(row.left_m.value_or(0.0)) > kFarBeside_m;
          },
          [](const FrameRow& row) { return std::abs(row.left_m.value_or(0.0)); },
          [](const FrameRow& row, std::size_t) {
            return fmt::format("up to {:.2f} m {} of the path by its own estimate (+- {:.2f})",
                               std::abs(*row.left_m), *row.left_m > 0.0 ? "left" : "right",
                               row.left_sigma_m.value_or(0.0));
          }};
}

Sections BesideInTruth(const RunLog& log) {
  return {"truly beside", 28.0,
          [&log](std::size_t i) { return log.frames[i].true_off_m.value_or(0.0) > kFarInTruth_m; },
          [](const FrameRow& row) { return row.true_off_m.value_or(0.0); },
          [](const FrameRow& row, std::size_t) {
            std::string text = fmt::format("truly up to {:.2f} m from the path", *row.true_off_m);
            if (row.left_m) {
              text += fmt::format(" where the estimate says {:.2f} (+- {:.2f})",
                                  std::abs(*row.left_m), row.left_sigma_m.value_or(0.0));
            }
            return text;
          }};
}

Sections OdometryLies(const RunLog& log) {
  return {"odometry", 18.0,
          [&log](std::size_t i) {
            const FrameRow& row = log.frames[i];
            return Driving(row) && row.odometry_trust.value_or(1.0) < kNotBelieved;
          },
          [](const FrameRow& row) { return 1.0 - row.odometry_trust.value_or(1.0); },
          [](const FrameRow& row, std::size_t frames) {
            return fmt::format(
                "the odometry contradicts the pictures: believed to {:.0f} % at worst ({} frames)",
                100.0 * *row.odometry_trust, frames);
          }};
}

// Finds where the robot drove more slowly than the segment was taught, although it was sure. The
// route's end is approached that way.
std::vector<Incident> Slow(const RunLog& log) {
  std::vector<double> taught_mps(log.frames.size(), 0.0);
  const auto stays = StaysOf(log);
  for (const Stay& stay : stays) {
    if (stay.begun == nullptr || &stay == &stays.back()) continue;
    std::fill(taught_mps.begin() + static_cast<std::ptrdiff_t>(stay.first),
              taught_mps.begin() + static_cast<std::ptrdiff_t>(stay.end),
              stay.begun->fields.Number("speed_mps").value_or(0.0));
  }
  return Find(log, {"slow", 15.0,
                    [&](std::size_t i) {
                      return Driving(log.frames[i]) &&
                             std::abs(log.frames[i].linear_mps) < kSlowShare * taught_mps[i];
                    },
                    [](const FrameRow& row) { return -std::abs(row.linear_mps); },
                    [](const FrameRow& row, std::size_t frames) {
                      return fmt::format("slower than taught: down to {:.2f} m/s ({} frames)",
                                         row.linear_mps, frames);
                    }});
}

// Finds where many features are lost from one frame to the next.
std::vector<Incident> Drops(const RunLog& log) {
  std::vector<Incident> incidents;
  for (std::size_t i = 1; i < log.frames.size(); ++i) {
    const FrameRow& row = log.frames[i];
    const int had = log.frames[i - 1].tracked;
    const int gone = row.left_picture + row.not_returned;
    if (gone < kManyLost || gone < kLargeShareLost * had) continue;
    incidents.push_back(
        {"drop", i, i, 22.0 + 5.0 * Share(gone, had),
         fmt::format("{} of {} features gone at once: {} lost in tracking (covered or blurred), {} "
                     "left the picture",
                     gone, had, row.not_returned, row.left_picture)});
  }
  return incidents;
}

std::vector<Incident> LookedAgain(const RunLog& log) {
  std::vector<Incident> incidents;
  if (log.frames.empty()) return incidents;
  for (const RunEvent& event : log.events) {
    const bool recovered = event.what == "recovered";
    if (event.what != "looked-again" && !recovered) continue;
    const std::size_t row = RowOfFrame(log, event.frame);
    incidents.push_back({event.what, row, row, recovered ? 35.0 : 5.0,
                         fmt::format("{}: {} of {} features",
                                     recovered ? "found itself again by a search far and wide"
                                               : "looked for lost features again",
                                     event.fields.Find("found").value_or("?"),
                                     event.fields.Find("stored").value_or("?"))});
  }
  return incidents;
}

std::vector<Incident> CarriedOff(const RunLog& log) {
  std::vector<Incident> incidents;
  if (log.frames.empty()) return incidents;
  for (const RunEvent& event : log.events) {
    const auto left_m = event.what == "carried" ? event.fields.Number("left_m") : std::nullopt;
    if (!left_m) continue;
    const std::size_t row = RowOfFrame(log, event.frame);
    incidents.push_back({event.what, row, row, 40.0,
                         fmt::format("carried off, by what it sees: {:.2f} m further to the {}",
                                     std::abs(*left_m), *left_m > 0.0 ? "left" : "right")});
  }
  return incidents;
}

}  // namespace

std::vector<Incident> FrameIncidents(const RunLog& log) {
  std::vector<Incident> all;
  for (const auto& found : {Drops(log), Find(log, Disagreeing(log)), Find(log, Beside(log)),
                            Find(log, BesideInTruth(log)), Find(log, OdometryLies(log)), Slow(log),
                            LookedAgain(log), CarriedOff(log)}) {
    all.insert(all.end(), found.begin(), found.end());
  }
  return all;
}

}  // namespace trailcast::explain
