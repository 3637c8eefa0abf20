#include "services/console/src/api/run_body.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "agent/diagnosis/run_log_format.h"
#include "services/program/json.h"

namespace trailcast::console {
namespace {

using agent::FrameRow;
using agent::Phase;
using agent::RunEvent;
using agent::RunLog;
using program::JsonList;
using program::JsonText;

constexpr std::size_t kCells = 400;
constexpr std::size_t kMostMarks = 300;
constexpr double kLeastDriven_m = 0.2;
constexpr double kStands_s = 1.0;

std::string Number(std::optional<double> value) {
  return value && std::isfinite(*value) ? fmt::format("{:.6g}", *value) : "null";
}
// Of a second since the first frame, or the epoch.
std::string Time(std::optional<double> value) {
  return value && std::isfinite(*value) ? fmt::format("{:.13g}", *value) : "null";
}

std::string SummaryFields(const RunFile& file, const RunSummary& summary, bool is_written) {
  return fmt::format(
      R"("run": {}, "file": {}, "bytes": {}, "written_unix_ms": {}, "robot": {}, "route": {}, )"
      R"("revision": {}, "mission": {}, "method": {}, "began_unix_ms": {}, "lasted_s": {}, )"
      R"("driven_m": {}, "progress": {}, "state": {}, "reason": {}, "under_way": {})",
      JsonText(file.id), JsonText(file.name), file.bytes, file.written_unix_ms,
      JsonText(summary.robot), JsonText(summary.route), JsonText(summary.revision),
      JsonText(summary.mission), JsonText(summary.method), Time(summary.began_unix_ms),
      Number(summary.lasted_s), Number(summary.driven_m), Number(summary.progress),
      JsonText(summary.state), JsonText(summary.reason), is_written);
}

// How sure it was: 0 lost, 1 sees nothing to go by, 2 unsure, 3 sure; 4: it had nothing to do yet.
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

// Where a row is along the strip, or when.
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

// Of a cell the least sure row, and the place that is the furthest from the path.
std::string CellsJson(const RunLog& log, const Along& along) {
  std::vector<std::string> at;
  std::vector<std::string> rows;
  std::vector<std::string> sure;
  std::vector<std::string> left;
  std::vector<std::string> sigma;
  for (std::size_t row = 0; row < log.frames.size();) {
    const double width = std::max(along.length() / kCells, 1e-9);
    const double begin = along.At(row);
    const double end = (std::floor(begin / width) + 1.0) * width;
    int least = 4;
    const FrameRow* beside = nullptr;
    at.push_back(Number(begin));
    rows.push_back(std::to_string(row));
    for (; row < log.frames.size() && along.At(row) < end; ++row) {
      const FrameRow& frame = log.frames[row];
      least = std::min(least, SurenessOf(frame.phase));
      if (frame.left_m &&
          (beside == nullptr || std::abs(*frame.left_m) > std::abs(*beside->left_m)))
        beside = &frame;
    }
    sure.push_back(std::to_string(least));
    left.push_back(Number(beside != nullptr ? beside->left_m : std::nullopt));
    sigma.push_back(Number(beside != nullptr ? beside->left_sigma_m : std::nullopt));
  }
  return fmt::format(R"({{"at": {}, "row": {}, "sure": {}, "left_m": {}, "left_sigma_m": {}}})",
                     JsonList(at), JsonList(rows), JsonList(sure), JsonList(left), JsonList(sigma));
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

// What is told of hand-overs may be left out, where there is more.
std::string MarksJson(const RunLog& log, const Along& along) {
  std::vector<Mark> marks;
  AddEvents(log, false, marks);
  AddStands(log, marks);
  AddEvents(log, true, marks);
  std::stable_sort(marks.begin(), marks.end(),
                   [](const Mark& one, const Mark& other) { return one.row < other.row; });
  std::vector<std::string> all;
  for (const Mark& mark : marks) {
    all.push_back(fmt::format(R"({{"row": {}, "at": {}, "what": {}, "text": {}}})", mark.row,
                              Number(along.At(mark.row)), JsonText(mark.what),
                              JsonText(mark.text)));
  }
  return JsonList(all);
}

std::string StripJson(const RunLog& log, RunAxis axis) {
  if (log.frames.empty()) return "null";
  const Along along(log, axis);
  return fmt::format(R"({{"unit": "{}", "length": {}, "cells": {}, "marks": {}}})", along.unit(),
                     Number(along.length()), CellsJson(log, along), MarksJson(log, along));
}

std::string LinesJson(const std::vector<std::string>& lines) {
  std::vector<std::string> all;
  for (const std::string& line : lines) all.push_back(JsonText(line));
  return JsonList(all);
}

std::string StoryJson(const explain::Story& story) {
  std::vector<std::string> happened;
  for (const explain::Happening& each : story.happened) {
    happened.push_back(fmt::format(R"({{"first": {}, "last": {}, "where": {}, "text": {}}})",
                                   each.first, each.last, JsonText(each.where),
                                   JsonText(each.text)));
  }
  return fmt::format(
      R"({{"who": {}, "outcome": {}, "how_far": {}, "missing": {}, "happened": {}, "lesser": {}, )"
      R"("figures": {}}})",
      JsonText(story.who), JsonText(story.outcome), JsonText(story.how_far),
      LinesJson(story.missing), JsonList(happened), story.lesser, LinesJson(story.figures));
}

std::string FrameJson(const RunLog& log, std::size_t row) {
  const FrameRow& frame = log.frames[row];
  std::vector<std::string> says;
  for (const explain::Said& each : explain::TellFrame(log, row)) {
    says.push_back(fmt::format("[{}, {}]", JsonText(each.about), JsonText(each.text)));
  }
  return fmt::format(
      R"({{"row": {}, "frame": {}, "t_s": {}, "driven_m": {}, "phase": "{}", "sure": {}, )"
      R"("turn_rad": {}, "left_m": {}, "left_sigma_m": {}, "says": {}}})",
      row, frame.frame, Time(frame.t_s - log.frames.front().t_s), Number(frame.driven_m),
      ToString(frame.phase), SurenessOf(frame.phase), Number(frame.turn_rad), Number(frame.left_m),
      Number(frame.left_sigma_m), JsonList(says));
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
  std::vector<std::string> runs;
  for (const Runs::Listed& each : page.runs) {
    runs.push_back(fmt::format("{{{}}}", SummaryFields(each.file, each.summary, each.is_written)));
  }
  return fmt::format(R"({{"runs": {}, "next": {}, "unread": {}}})", JsonList(runs), page.next,
                     page.unread);
}

std::string RunBody(const OpenedRun& run, RunAxis axis) {
  return fmt::format(R"({{{}, "rows": {}, "pictures": {}, "story": {}, "strip": {}}})",
                     SummaryFields(run.file, run.summary, false), run.log.frames.size(),
                     run.has_pictures(), StoryJson(run.story), StripJson(run.log, axis));
}

std::string RunFramesBody(const OpenedRun& run, std::size_t first) {
  std::vector<std::string> frames;
  const std::size_t end = std::min(run.log.frames.size(), first + kMostFramesAtOnce);
  for (std::size_t row = first; row < end; ++row) frames.push_back(FrameJson(run.log, row));
  return fmt::format(R"({{"frames": {}}})", JsonList(frames));
}

std::string RunSeenBody(const OpenedRun& run, std::size_t row, const OpenedRun::Seen& seen) {
  std::vector<std::string> features;
  for (const agent::SeenFeature& each : seen.features) {
    features.push_back(fmt::format(R"([{}, {}, {}, {}, "{}"])", Number(each.u_px),
                                   Number(each.v_px), Number(each.to_u_px), Number(each.to_v_px),
                                   WordOf(each.verdict)));
  }
  // The picture is that of an earlier row, perhaps.
  std::string picture = "null";
  std::string age = "null";
  if (seen.picture) {
    const auto& frames = run.log.frames;
    const auto of = std::partition_point(
        frames.begin(), frames.begin() + static_cast<std::ptrdiff_t>(row),
        [&](const FrameRow& each) { return each.t_s < seen.picture->t_s - 0.001; });
    picture = std::to_string(of - frames.begin());
    age = Number(std::max(0.0, frames[row].t_s - seen.picture->t_s));
  }
  return fmt::format(R"({{"features": {}, "picture": {}, "picture_age_s": {}}})",
                     JsonList(features), picture, age);
}

}  // namespace trailcast::console
