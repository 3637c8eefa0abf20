#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "services/base/angles.h"
#include "services/explain/src/run_index.h"
#include "services/explain/story.h"

namespace trailcast::explain {
namespace {

using agent::FrameRow;
using agent::RunEvent;
using agent::RunLog;

const char* SideOf(double left) { return left > 0.0 ? "left" : "right"; }

// Says how the frame's phase began.
std::string Mode(const RunLog& log, const FrameRow& row) {
  std::string text = ToString(row.phase);
  const auto after =
      std::upper_bound(log.events.begin(), log.events.end(), row.frame,
                       [](int frame, const RunEvent& event) { return frame < event.frame; });
  const auto change = std::find_if(std::make_reverse_iterator(after), log.events.rend(),
                                   [](const RunEvent& event) { return event.what == "phase"; });
  if (change == log.events.rend() || change->fields.Find("to") != text) return text;
  text += fmt::format(" since frame {}", change->frame);
  return change->text.empty() ? text : text + ": " + change->text;
}

std::string Features(const FrameRow& row) {
  std::string text = fmt::format("{} of {} followed, {} agree with the route", row.tracked,
                                 row.stored, row.agreeing);
  if (row.rejected > 0) {
    text += fmt::format(", {} do not, by {:.0f} px", row.rejected, row.rejected_by_px);
  }
  if (row.left_picture > 0) text += fmt::format(", {} left the picture", row.left_picture);
  if (row.not_returned > 0) text += fmt::format(", {} lost in tracking", row.not_returned);
  return text;
}

std::string Turn(const FrameRow& row) {
  std::string text =
      fmt::format("{:.1f} degrees {}", Degrees(std::abs(row.turn_rad)), SideOf(-row.turn_rad));
  if (row.vision_turn_rad && row.odometry_turn_rad) {
    text += fmt::format(" (features {:+.1f}, odometry {:+.1f})", Degrees(*row.vision_turn_rad),
                        Degrees(*row.odometry_turn_rad));
  }
  return text + fmt::format(", at {:.2f} m/s", row.linear_mps);
}

std::string Along(const FrameRow& row) {
  std::string text = fmt::format("{:.0f} % of the route, segment {}, {:.0f} % of it",
                                 100.0 * row.progress, row.segment, 100.0 * row.fraction);
  if (row.driven_m) text += fmt::format(", {:.2f} m driven", *row.driven_m);
  return text;
}

std::string Beside(const FrameRow& row) {
  std::string text =
      fmt::format("{:.2f} m {} of the path", std::abs(*row.left_m), SideOf(*row.left_m));
  if (row.left_sigma_m) text += fmt::format(", +- {:.2f} m", *row.left_sigma_m);
  if (row.heading_rad) {
    text += fmt::format(", looking {:.1f} degrees {}", Degrees(std::abs(*row.heading_rad)),
                        SideOf(*row.heading_rad));
  }
  return text;
}

std::string Odometry(const FrameRow& row) {
  std::string text = fmt::format("believed to {:.0f} %", 100.0 * *row.odometry_trust);
  if (row.odometry_scale) {
    text += fmt::format("; each of its metres is {:.2f} of the route's", *row.odometry_scale);
  }
  return text;
}

std::string Belief(const FrameRow& row) {
  std::string text = fmt::format("at {:.1f} % of the route", 100.0 * *row.place);
  if (row.place_sigma) text += fmt::format(", +- {:.1f} %", 100.0 * *row.place_sigma);
  if (row.off_route)
    text += fmt::format("; off it by a chance of {:.0f} %", 100.0 * *row.off_route);
  return text;
}

}  // namespace

std::vector<Said> TellFrame(const RunLog& log, std::size_t number) {
  const FrameRow& row = log.frames[number];
  std::vector<Said> said{{"Mode", Mode(log, row)}, {"Along", Along(row)}};
  if (row.left_m) said.push_back({"Beside", Beside(row)});
  if (row.place) said.push_back({"Belief", Belief(row)});
  if (row.odometry_trust) said.push_back({"Odometry", Odometry(row)});
  if (row.stored > 0) said.push_back({"Features", Features(row)});
  said.push_back({"Turn", Turn(row)});
  if (row.delta) said.push_back({"Delta", fmt::format("{:.2f}", *row.delta)});
  if (row.true_off_m) {
    said.push_back({"In truth", fmt::format("{:.2f} m from the path", *row.true_off_m)});
  }
  const auto events = std::equal_range(
      log.events.begin(), log.events.end(), RunEvent{row.frame, 0.0, {}, {}, {}},
      [](const RunEvent& one, const RunEvent& other) { return one.frame < other.frame; });
  for (auto event = events.first; event != events.second; ++event) {
    if (event->what != "phase") said.push_back({"Event", agent::DescribeEvent(*event)});
  }
  return said;
}

}  // namespace trailcast::explain
