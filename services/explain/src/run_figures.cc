#include "services/explain/src/run_figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iterator>
#include <numbers>
#include <numeric>
#include <optional>

#include "services/explain/src/run_index.h"

namespace trailcast::explain {
namespace {

using agent::Evidence;
using agent::FrameRow;
using agent::Phase;
using agent::RunEvent;
using agent::RunLog;

using Value = std::function<std::optional<double>(const FrameRow&)>;

struct Spread {
  std::size_t count = 0;
  double mean = 0.0;
  double median = 0.0;
  double largest = 0.0;
};

Spread Of(std::vector<double> values) {
  Spread spread{values.size()};
  if (values.empty()) return spread;
  spread.mean =
      std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
  spread.largest = *std::max_element(values.begin(), values.end());
  const auto middle = values.begin() + std::ssize(values) / 2;
  std::nth_element(values.begin(), middle, values.end());
  spread.median = *middle;
  return spread;
}

bool UnderWay(const FrameRow& row) {
  return row.phase != Phase::kWaiting && row.phase != Phase::kArrived && row.phase != Phase::kLost;
}

Spread Over(const RunLog& log, const Value& value) {
  std::vector<double> values;
  for (const FrameRow& row : log.frames) {
    const auto each = UnderWay(row) ? value(row) : std::nullopt;
    if (each) values.push_back(*each);
  }
  return Of(std::move(values));
}

int Sum(const RunLog& log, int FrameRow::*member) {
  int sum = 0;
  for (const FrameRow& row : log.frames) sum += row.*member;
  return sum;
}

std::string Line(const char* what, const std::string& figures) {
  return fmt::format("{:<18}{}", what, figures);
}

void AddHandOvers(const RunLog& log, std::vector<std::string>& lines) {
  std::vector<double> shares;
  int wide = 0;
  int again = 0;
  std::string worst = "?";
  for (const RunEvent& event : log.events) {
    again += event.what == "looked-again" ? 1 : 0;
    if (event.what != "hand-over") continue;
    const double share = Share(event.fields.Number("found").value_or(0.0),
                               event.fields.Number("stored").value_or(0.0));
    if (shares.empty() || share < *std::min_element(shares.begin(), shares.end())) {
      worst = event.fields.Find("segment").value_or("?");
    }
    shares.push_back(share);
    wide += event.fields.Find("search") == "wide" ? 1 : 0;
  }
  if (shares.empty()) return;
  const Spread spread = Of(shares);
  lines.push_back(Line(
      "hand-overs",
      fmt::format("{}: {:.0f} % of the features found on average, least {:.0f} % "
                  "(segment {}); {} by the wide search; looked again {} times",
                  spread.count, 100.0 * spread.mean,
                  100.0 * *std::min_element(shares.begin(), shares.end()), worst, wide, again)));
}

void AddFeatures(const RunLog& log, std::vector<std::string>& lines) {
  const Spread share = Over(log, [](const FrameRow& row) -> std::optional<double> {
    if (row.stored == 0) return std::nullopt;
    return Share(row.agreeing, row.stored);
  });
  const Spread agreeing = Over(log, [](const FrameRow& row) { return row.agreeing; });
  if (share.count == 0) return;
  lines.push_back(Line("in view", fmt::format("{:.1f} features agree with the route on average, "
                                              "median {:.0f}: {:.0f} % of the segments' own",
                                              agreeing.mean, agreeing.median, 100.0 * share.mean)));
  lines.push_back(
      Line("lost", fmt::format("{} left the picture, {} in tracking; {:.1f} a frame disagree",
                               Sum(log, &FrameRow::left_picture), Sum(log, &FrameRow::not_returned),
                               Over(log, [](const FrameRow& row) { return row.rejected; }).mean)));
}

void AddTurns(const RunLog& log, std::vector<std::string>& lines) {
  const Spread turn = Over(log, [](const FrameRow& row) { return std::abs(row.turn_rad); });
  if (turn.count == 0) return;
  std::string text = fmt::format("{:.3f} rad on average, largest {:.3f}", turn.mean, turn.largest);
  const Spread opposed = Over(log, [](const FrameRow& row) -> std::optional<double> {
    if (!row.vision_turn_rad || !row.odometry_turn_rad) return std::nullopt;
    return *row.vision_turn_rad * *row.odometry_turn_rad < 0.0 ? 1.0 : 0.0;
  });
  if (opposed.count > 0) {
    text += fmt::format("; vision and odometry opposed in {:.0f} % of the frames",
                        100.0 * opposed.mean);
  }
  lines.push_back(Line("turn asked for", text));
}

void AddOffset(const RunLog& log, std::vector<std::string>& lines) {
  const auto left = [](const FrameRow& row) -> std::optional<double> {
    if (!row.left_m) return std::nullopt;
    return std::abs(*row.left_m);
  };
  const Spread offset = Over(log, left);
  if (offset.count > 0) {
    const Spread sigma = Over(log, [](const FrameRow& row) { return row.left_sigma_m; });
    const FrameRow& last = log.frames.back();
    const double yaw_deg = last.mount_yaw_rad.value_or(0.0) * 180.0 / std::numbers::pi;
    lines.push_back(Line("beside the path",
                         fmt::format("{:.3f} m by its own estimate on average, largest {:.3f} (+- "
                                     "{:.3f})",
                                     offset.mean, offset.largest, sigma.mean)));
    lines.push_back(Line("camera", fmt::format("{:.2f} times the scout's magnification, mounted "
                                               "{:.1f} degrees further {}",
                                               last.magnification, std::abs(yaw_deg),
                                               yaw_deg > 0.0 ? "left" : "right")));
  }
  const Spread truth = Over(log, [](const FrameRow& row) { return row.true_off_m; });
  if (truth.count == 0) return;
  lines.push_back(Line("in truth", fmt::format("{:.3f} m from the path on average, largest {:.3f}",
                                               truth.mean, truth.largest)));
}

void AddEvidence(const RunLog& log, std::vector<std::string>& lines) {
  const auto share = [&](Evidence evidence) {
    return 100.0 * Over(log, [evidence](const FrameRow& row) {
                     return row.evidence == evidence ? 1.0 : 0.0;
                   }).mean;
  };
  lines.push_back(Line(
      "goes by",
      fmt::format("features in {:.0f} % of the frames, the view as a whole in "
                  "{:.0f} %, motion alone in {:.0f} %",
                  share(Evidence::kFeatures), share(Evidence::kViews), share(Evidence::kMotion))));
  const Spread doubt = Over(log, [](const FrameRow& row) -> std::optional<double> {
    if (!row.odometry_trust) return std::nullopt;
    return 1.0 - *row.odometry_trust;
  });
  if (doubt.count == 0) return;
  std::string text = fmt::format("believed to {:.0f} % on average, {:.0f} % at least",
                                 100.0 * (1.0 - doubt.mean), 100.0 * (1.0 - doubt.largest));
  if (const auto scale = log.frames.back().odometry_scale) {
    text += fmt::format("; at last each of its metres was {:.2f} of the route's", *scale);
  }
  lines.push_back(Line("odometry", text));
}

// Frames by what they cost: those with a search, of each kind, and plain ones.
enum FrameKind { kPlain, kNear, kWide, kAgain, kSearching, kFrameKinds };

std::vector<FrameKind> KindsOf(const RunLog& log) {
  std::vector<FrameKind> kinds;
  for (const FrameRow& row : log.frames) {
    const bool searching =
        row.phase == Phase::kBlind || row.phase == Phase::kSeeking || row.phase == Phase::kLooking;
    kinds.push_back(searching ? kSearching : kPlain);
  }
  for (const RunEvent& event : log.events) {
    const bool again = event.what == "looked-again" || event.what == "recovered";
    if (kinds.empty() || (event.what != "hand-over" && !again)) continue;
    FrameKind& kind = kinds[RowOfFrame(log, event.frame)];
    if (kind == kSearching) continue;  // the searches themselves take the time
    kind = again ? kAgain : event.fields.Find("search") == "wide" ? kWide : kNear;
  }
  return kinds;
}

void AddTimes(const RunLog& log, std::vector<std::string>& lines) {
  const Spread all = Over(log, [](const FrameRow& row) { return row.cpu_ms; });
  if (all.count == 0) return;
  lines.push_back(
      Line("CPU time a frame", fmt::format("{:.2f} ms median, {:.2f} mean, {:.1f} largest",
                                           all.median, all.mean, all.largest)));
  constexpr std::array kNames{"only tracked and judged", "hand-over near by",
                              "hand-over, wide search", "looked again", "searching, blind"};
  const auto kinds = KindsOf(log);
  std::string text;
  std::size_t slowest = kPlain;
  double slowest_ms = 0.0;
  for (std::size_t kind = 0; kind < kFrameKinds; ++kind) {
    std::vector<double> times;
    for (std::size_t i = 0; i < kinds.size(); ++i) {
      if (kinds[i] == kind) times.push_back(log.frames[i].cpu_ms);
    }
    const Spread spread = Of(times);
    if (spread.count == 0) continue;
    text += fmt::format("{}{} {:.2f} ms ({})", text.empty() ? "" : ", ", kNames.at(kind),
                        spread.mean, spread.count);
    if (spread.mean > slowest_ms) slowest = kind;
    slowest_ms = std::max(slowest_ms, spread.mean);
  }
  lines.push_back(Line("  by frames", text));
  lines.push_back(Line("  slowest", kNames.at(slowest)));
}

}  // namespace

std::vector<std::string> RunFigures(const RunLog& log) {
  std::vector<std::string> lines;
  if (log.frames.empty()) return lines;
  AddHandOvers(log, lines);
  AddFeatures(log, lines);
  AddTurns(log, lines);
  AddOffset(log, lines);
  AddEvidence(log, lines);
  AddTimes(log, lines);
  return lines;
}

}  // namespace trailcast::explain
