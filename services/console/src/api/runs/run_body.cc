#include "services/console/src/api/runs/run_body.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "agent/diagnosis/run_log.h"
#include "services/program/json.h"

namespace trailcast::console {
namespace {

using agent::FrameRow;
using agent::Phase;
using agent::RunEvent;
using agent::RunLog;
using program::Json;
using program::OneLine;

constexpr std::size_t kCells = 400;
constexpr std::size_t kMostMarks = 300;
constexpr double kLeastDriven_m = 0.2;
constexpr double kStands_s = 1.0;

// A ten-thousandth of a metre, or of a pixel, is enough.
Json Number(std::optional<double> value) { return program::RoundedOrNull(value, 1e4); }

Json SummaryJson(const RunFile& file, const RunSummary& summary, bool is_written) {
  return {{"run", file.id},
          {"file", file.name},
          {"bytes", file.bytes},
          {"written_unix_ms", file.written_unix_ms},
          {"robot", summary.robot},
          {"route", summary.route},
          {"revision", summary.revision},
          {"mission", summary.mission},
          {"method", summary.method},
          {"began_unix_ms", program::OrNull(summary.began_unix_ms)},
          {"lasted_s", Number(summary.lasted_s)},
          {"driven_m", Number(summary.driven_m)},
          {"progress", Number(summary.progress)},
          {"state", summary.state},
          {"reason", summary.reason},
          {"under_way", is_written}};
}

// Returns how sure the robot was: 0 lost, 1 without visual evidence, 2 unsure, 3 sure, 4 without a
// task yet.
int SurenessOf(Phase phase) {
  switch (phase) {
    case Phase::kLost:
      return 0;
    case Phase::kBlind:
    case Phase::kCovered:
    case Phase::kSeeking:
    case Phase::kLooking:
      return 1;
    case Phase::kUnsure:
    case Phase::kDistant:
      return 2;
    case Phase::kSure:
    case Phase::kArrived:
      return 3;
    case Phase::kWaiting:
      break;
  }
  return 4;
}

// This is where a row is along the strip, in metres or in time.
class Along {
 public:
  Along(const RunLog& log, RunAxis axis) : log_(log) {
    metres_ = axis == RunAxis::kMetres && log.frames.back().driven_m.value_or(0) >= kLeastDriven_m;
    length_ = At(log.frames.size() - 1);
    for (std::size_t row = 0; row < log.frames.size(); ++row) length_ = std::max(length_, At(row));
  }
  [[nodiscard]] double At(std::size_t row) const {
    const FrameRow& frame = log_.frames[row];
    return metres_ ? frame.driven_m.value_or(0.0) : frame.t_s - log_.frames.front().t_s;
  }
  [[nodiscard]] double length() const { return length_; }
  [[nodiscard]] const char* unit() const { return metres_ ? "m" : "s"; }

 private:
  const RunLog& log_;
  bool metres_ = false;
  double length_ = 0.0;
};

// Returns for each cell its least sure row, and its place that is furthest from the path.
Json CellsJson(const RunLog& log, const Along& along) {
  Json at = Json::array();
  Json rows = Json::array();
  Json sure = Json::array();
  Json left = Json::array();
  Json sigma = Json::array();
  for (std::size_t row = 0; row < log.frames.size();) {
    const double width = std::max(along.length() / kCells, 1e-9);
    const double begin = along.At(row);
    const double end = (std::floor(begin / width) + 1.0) * width;
    int least = 4;
    const FrameRow* beside = nullptr;
    at.push_back(Number(begin));
    rows.push_back(row);
    for (; row < log.frames.size() && along.At(row) < end; ++row) {
      const FrameRow& frame = log.frames[row];
      least = std::min(least, SurenessOf(frame.phase));
      if (frame.left_m &&
          (beside == nullptr || std::abs(*frame.left_m) > std::abs(*beside->left_m)))
        beside = &frame;
    }
    sure.push_back(least);
    left.push_back(Number(beside != nullptr ? beside->left_m : std::nullopt));
    sigma.push_back(Number(beside != nullptr ? beside->left_sigma_m : std::nullopt));
  }
  return {{"at", std::move(at)},
          {"row", std::move(rows)},
          {"sure", std::move(sure)},
          {"left_m", std::move(left)},
          {"left_sigma_m", std::move(sigma)}};
}

struct Mark {
  std::size_t row = 0;
  std::string what;
  std::string text;
};

void AddEvents(const RunLog& log, bool hand_overs, std::vector<Mark>& marks) {
  for (const RunEvent& event : log.events) {
    if (marks.size() >= kMostMarks) return;
    const bool lost = event.what == "phase" && event.fields.Find("to") == "lost";
    if ((event.what == "phase" && !lost) || event.what == "complete" ||
        (event.what == "hand-over") != hand_overs)
      continue;
    const auto row =
        std::partition_point(log.frames.begin(), log.frames.end(),
                             [&](const FrameRow& each) { return each.frame < event.frame; });
    marks.push_back(
        {std::min(static_cast<std::size_t>(row - log.frames.begin()), log.frames.size() - 1),
         lost ? "lost" : event.what, agent::DescribeEvent(event)});
  }
}

void AddStands(const RunLog& log, std::vector<Mark>& marks) {
  const auto stands = [&](std::size_t row) {
    const FrameRow& frame = log.frames[row];
    return frame.linear_mps == 0.0 && frame.angular_radps == 0.0;
  };
  for (std::size_t row = 0; row < log.frames.size() && marks.size() < kMostMarks; ++row) {
    if (!stands(row)) continue;
    const std::size_t first = row;
    while (row + 1 < log.frames.size() && stands(row + 1)) ++row;
    const double stood_s = log.frames[row].t_s - log.frames[first].t_s;
    if (stood_s < kStands_s) continue;
    marks.push_back({first, "stands", fmt::format("stands for {:.1f} s", stood_s)});
  }
}

// Marks of hand-overs are left out if there are too many marks.
Json MarksJson(const RunLog& log, const Along& along) {
  std::vector<Mark> marks;
  AddEvents(log, false, marks);
  AddStands(log, marks);
  AddEvents(log, true, marks);
  std::stable_sort(marks.begin(), marks.end(),
                   [](const Mark& one, const Mark& other) { return one.row < other.row; });
  Json all = Json::array();
  for (const Mark& mark : marks) {
    all.push_back({{"row", mark.row},
                   {"at", Number(along.At(mark.row))},
                   {"what", mark.what},
                   {"text", mark.text}});
  }
  return all;
}

Json StripJson(const RunLog& log, RunAxis axis) {
  if (log.frames.empty()) return nullptr;
  const Along along(log, axis);
  return {{"unit", along.unit()},
          {"length", Number(along.length())},
          {"cells", CellsJson(log, along)},
          {"marks", MarksJson(log, along)}};
}

Json StoryJson(const explain::Story& story) {
  Json happened = Json::array();
  for (const explain::Happening& each : story.happened) {
    happened.push_back(
        {{"first", each.first}, {"last", each.last}, {"where", each.where}, {"text", each.text}});
  }
  return {{"who", story.who},         {"outcome", story.outcome},        {"how_far", story.how_far},
          {"missing", story.missing}, {"happened", std::move(happened)}, {"lesser", story.lesser},
          {"figures", story.figures}};
}

Json FrameJson(const RunLog& log, std::size_t row) {
  const FrameRow& frame = log.frames[row];
  Json says = Json::array();
  for (const explain::Said& each : explain::TellFrame(log, row)) {
    says.push_back(Json::array({each.about, each.text}));
  }
  return {{"row", row},
          {"frame", frame.frame},
          {"t_s", Number(frame.t_s - log.frames.front().t_s)},
          {"driven_m", Number(frame.driven_m)},
          {"phase", ToString(frame.phase)},
          {"sure", SurenessOf(frame.phase)},
          {"turn_rad", Number(frame.turn_rad)},
          {"left_m", Number(frame.left_m)},
          {"left_sigma_m", Number(frame.left_sigma_m)},
          {"says", std::move(says)}};
}

const char* WordOf(replay::FeatureVerdict verdict) {
  switch (verdict) {
    case replay::FeatureVerdict::kInside:
      return "inside";
    case replay::FeatureVerdict::kAsksLeft:
      return "left";
    case replay::FeatureVerdict::kAsksRight:
      return "right";
    case replay::FeatureVerdict::kRejected:
      break;
  }
  return "rejected";
}

}  // namespace

std::string RunsBody(const Runs::Page& page) {
  Json runs = Json::array();
  for (const Runs::Listed& each : page.runs) {
    runs.push_back(SummaryJson(each.file, each.summary, each.is_written));
  }
  return OneLine({{"runs", std::move(runs)}, {"next", page.next}, {"unread", page.unread}});
}

std::string RunBody(const OpenedRun& run, RunAxis axis) {
  Json body = SummaryJson(run.file, run.summary, false);
  body["rows"] = run.log.frames.size();
  body["pictures"] = run.has_pictures();
  body["story"] = StoryJson(run.story);
  body["strip"] = StripJson(run.log, axis);
  return OneLine(body);
}

std::string RunFramesBody(const OpenedRun& run, std::size_t first) {
  Json frames = Json::array();
  const std::size_t end = std::min(run.log.frames.size(), first + kMostFramesAtOnce);
  for (std::size_t row = first; row < end; ++row) frames.push_back(FrameJson(run.log, row));
  return OneLine({{"frames", std::move(frames)}});
}

std::string RunSeenBody(const OpenedRun& run, std::size_t row, const OpenedRun::Seen& seen) {
  Json features = Json::array();
  for (const agent::SeenFeature& each : seen.features) {
    features.push_back({Number(each.u_px), Number(each.v_px), Number(each.to_u_px),
                        Number(each.to_v_px), WordOf(each.verdict)});
  }
  // The picture may be from an earlier row.
  Json picture;
  Json age;
  if (seen.picture) {
    const auto& frames = run.log.frames;
    const auto of = std::partition_point(
        frames.begin(), frames.begin() + static_cast<std::ptrdiff_t>(row),
        [&](const FrameRow& each) { return each.t_s < seen.picture->t_s - 0.001; });
    picture = of - frames.begin();
    age = Number(std::max(0.0, frames[row].t_s - seen.picture->t_s));
  }
  return OneLine({{"features", std::move(features)},
                  {"picture", std::move(picture)},
                  {"picture_age_s", std::move(age)}});
}

}  // namespace trailcast::console
