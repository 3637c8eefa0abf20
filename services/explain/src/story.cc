#include "services/explain/story.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "agent/diagnosis/run_log_format.h"
#include "services/explain/src/incidents.h"
#include "services/explain/src/run_figures.h"
#include "services/explain/src/run_index.h"

namespace trailcast::explain {
namespace {

using agent::FrameRow;
using agent::RunLog;

constexpr std::size_t kMostIncidents = 14;
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

// The weightiest, in the order in which they happened.
std::vector<Incident> Shortened(std::vector<Incident> incidents) {
  std::stable_sort(incidents.begin(), incidents.end(),
                   [](const Incident& a, const Incident& b) { return a.weight > b.weight; });
  incidents.resize(std::min(incidents.size(), kMostIncidents));
  std::stable_sort(incidents.begin(), incidents.end(),
                   [](const Incident& a, const Incident& b) { return a.first < b.first; });
  return incidents;
}

// Longer lines go on below, under their own beginning.
std::string Wrapped(const std::string& place, const std::string& text) {
  std::string lines = place;
  std::size_t width = place.size();
  for (const std::string_view word : agent::Words(text)) {
    if (width + 1 + word.size() > kWidth) {
      lines += fmt::format("\n{:{}}", "", place.size());
      width = place.size();
    }
    lines += fmt::format(" {}", word);
    width += 1 + word.size();
  }
  return lines + "\n";
}

std::string Tell(const RunLog& log, const Incident& incident) {
  const FrameRow& first = log.frames[incident.first];
  std::string text = incident.text;
  if (incident.times > 1) {
    const FrameRow& last = log.frames[incident.last];
    const std::string until = last.driven_m ? fmt::format("{:.2f} m", *last.driven_m)
                                            : fmt::format("frame {}", last.frame);
    text += fmt::format(" [{} times until {}]", incident.times, until);
  }
  return Wrapped(fmt::format("  {}", PlaceText(first)), text);
}

std::string WhatHappened(const RunLog& log, bool all) {
  const std::vector<Incident> found = FindIncidents(log);
  if (found.empty()) return "Nothing to tell: it was sure of the path all the way.\n";
  const std::vector<Incident> told = all ? found : Shortened(found);
  std::string text = "What happened\n";
  for (const Incident& incident : told) text += Tell(log, incident);
  if (told.size() < found.size()) {
    text += fmt::format("  and {} lesser things: --all\n", found.size() - told.size());
  }
  return text;
}

std::string WhatIsMissing(const RunLog& log, bool all) {
  std::string text;
  if (!log.ending) {
    text += "The log breaks off: the program was killed, or is still running.\n";
  }
  if (const auto dropped = log.header.Find("dropped")) {
    text += fmt::format("The log has gaps: dropped {}.\n", *dropped);
  }
  if (log.damaged_lines == 0) return text;
  text +=
      fmt::format("{} of the log's lines cannot be read and are left out:\n", log.damaged_lines);
  const std::size_t told = std::min<std::size_t>(all ? log.damage.size() : 3, log.damage.size());
  for (std::size_t i = 0; i < told; ++i) {
    text += fmt::format("  line {}: {}\n", log.damage[i].line, log.damage[i].what);
  }
  return text;
}

// Every line of the log that is not a frame.
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
      "'{}' ({} segments, {} m, taught by {} with {}), followed by {} with {}, method {}",
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

std::string TellStory(const RunLog& log, bool all) {
  std::string text = fmt::format("{}\n{}\n{}\n", WhoFollowedWhat(log), Outcome(log), HowFar(log));
  text += WhatIsMissing(log, all);
  if (log.frames.empty()) return text;
  text += fmt::format("\n{}\nIn figures\n", WhatHappened(log, all));
  for (const std::string& line : RunFigures(log)) text += fmt::format("  {}\n", line);
  if (all) text += fmt::format("\n{}", Events(log));
  return text;
}

}  // namespace trailcast::explain
