#include "services/explain/story.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <sstream>
#include <vector>

#include "services/explain/src/incidents.h"
#include "services/explain/src/run_figures.h"
#include "services/explain/src/run_index.h"

namespace trailcast::explain {
namespace {

using agent::FrameRow;
using agent::RunLog;

constexpr std::size_t kMostIncidents = 14;
constexpr std::size_t kAll = std::numeric_limits<std::size_t>::max();
constexpr std::size_t kFewDamaged = 3;
constexpr std::size_t kWidth = 110;  // of a line, in characters

std::string Known(const RunLog& log, const std::string& key) {
  const auto value = log.header.Find(key);
  return value && !value->empty() ? *value : "unknown";
}

std::string HowFar(const RunLog& log) {
  if (log.frames.empty()) return "no frame was looked at";
  const FrameRow& first = log.frames.front();
  const FrameRow& last = log.frames.back();
  std::string text = fmt::format("{} frames in {:.1f} s", log.frames.size(), last.t_s - first.t_s);
  text += last.driven_m ? fmt::format(", {:.2f} m driven", *last.driven_m)
                        : std::string(", no odometry: places are told by frame");
  return text + fmt::format(", {:.0f} % of the route", 100.0 * last.progress);
}

// Returns the weightiest incidents in the order in which they happened.
std::vector<Incident> Shortened(std::vector<Incident> incidents, std::size_t most) {
  std::stable_sort(incidents.begin(), incidents.end(),
                   [](const Incident& a, const Incident& b) { return a.weight > b.weight; });
  incidents.resize(std::min(incidents.size(), most));
  std::stable_sort(incidents.begin(), incidents.end(),
                   [](const Incident& a, const Incident& b) { return a.first < b.first; });
  return incidents;
}

// Breaks long lines; the continuation is aligned with the text.
std::string Wrapped(const std::string& place, const std::string& text) {
  std::string lines = place;
  std::size_t width = place.size();
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    if (width + 1 + word.size() > kWidth) {
      lines += fmt::format("\n{:{}}", "", place.size());
      width = place.size();
    }
    lines += fmt::format(" {}", word);
    width += 1 + word.size();
  }
  return lines + "\n";
}

Happening Tell(const RunLog& log, const Incident& incident) {
  std::string text = incident.text;
  if (incident.times > 1) {
    const FrameRow& last = log.frames[incident.last];
    const std::string until = last.driven_m ? fmt::format("{:.2f} m", *last.driven_m)
                                            : fmt::format("frame {}", last.frame);
    text += fmt::format(" [{} times until {}]", incident.times, until);
  }
  return {incident.first, incident.last, PlaceText(log.frames[incident.first]), std::move(text)};
}

std::vector<std::string> WhatIsMissing(const RunLog& log, std::size_t most) {
  std::vector<std::string> lines;
  if (!log.ending) {
    lines.emplace_back("The log breaks off: the program was killed, or is still running.");
  }
  const auto dropped =
      std::find_if(log.events.begin(), log.events.end(),
                   [](const agent::RunEvent& event) { return event.what == "dropped"; });
  if (dropped != log.events.end()) {
    lines.push_back(fmt::format("The log has gaps: dropped {}.", dropped->text));
  }
  if (log.damaged == 0) return lines;
  lines.push_back(
      fmt::format("Places of the log that cannot be read and are left out: {}", log.damaged));
  for (std::size_t i = 0; i < std::min(most, log.damage.size()); ++i) {
    lines.push_back("  " + log.damage[i]);
  }
  return lines;
}

std::string WhatHappened(const Story& story) {
  if (story.happened.empty()) return "Nothing to tell: it was sure of the path all the way.\n";
  std::string text = "What happened\n";
  for (const Happening& each : story.happened) text += Wrapped("  " + each.where, each.text);
  if (story.lesser > 0) text += fmt::format("  and {} lesser things: --all\n", story.lesser);
  return text;
}

// Lists all events of the log.
std::string Events(const RunLog& log) {
  std::string text = "Events\n";
  for (const agent::RunEvent& event : log.events) {
    text += fmt::format("  frame {:>5} {:>8.2f} s  {}", event.frame, event.t_s, event.what);
    for (const auto& [key, value] : event.fields.all()) text += fmt::format(" {}={}", key, value);
    text += fmt::format("{}{}\n", event.text.empty() ? "" : ": ", event.text);
  }
  return text;
}

}  // namespace

std::string WhoFollowedWhat(const RunLog& log) {
  return fmt::format(
      "'{}' ({} segments, {} m as the run began, taught by {} with {}), followed by {} with {}, "
      "method {}",
      Known(log, "route"), Known(log, "segments"), Known(log, "length_m"), Known(log, "scout"),
      Known(log, "scout_camera"), Known(log, "robot"), Known(log, "camera"), Known(log, "method"));
}

std::string Outcome(const RunLog& log) {
  if (log.ending) {
    const std::string state = log.ending->fields.Find("state").value_or("ended");
    return log.ending->text.empty() ? state : state + ": " + log.ending->text;
  }
  if (log.frames.empty()) return "unknown";
  return fmt::format("unknown; last seen {}", ToString(log.frames.back().phase));
}

Story MakeStory(const RunLog& log, std::size_t most_happenings) {
  const bool all = most_happenings == kAll;
  Story story{.who = WhoFollowedWhat(log),
              .outcome = Outcome(log),
              .how_far = HowFar(log),
              .missing = WhatIsMissing(log, all ? kAll : kFewDamaged),
              .happened = {},
              .figures = RunFigures(log)};
  if (log.frames.empty()) return story;
  std::vector<Incident> found = FindIncidents(log);
  const std::size_t count = found.size();
  if (!all) found = Shortened(std::move(found), most_happenings);
  for (const Incident& incident : found) story.happened.push_back(Tell(log, incident));
  story.lesser = count - found.size();
  return story;
}

std::string TellStory(const RunLog& log, bool all) {
  const Story story = MakeStory(log, all ? kAll : kMostIncidents);
  std::string text = fmt::format("{}\n{}\n{}\n", story.who, story.outcome, story.how_far);
  for (const std::string& line : story.missing) text += line + "\n";
  if (log.frames.empty()) return text;
  text += fmt::format("\n{}\nIn figures\n", WhatHappened(story));
  for (const std::string& line : story.figures) text += fmt::format("  {}\n", line);
  if (all) text += fmt::format("\n{}", Events(log));
  return text;
}

}  // namespace trailcast::explain
