#include "agent/diagnosis/run_log.h"

#include <algorithm>
#include <array>

#include "services/base/number.h"
#include "services/base/text.h"

namespace trailcast::agent {
namespace {

struct NamedPhase {
  const char* name;
  Phase phase;
};
constexpr std::array kPhases = {
    NamedPhase{"waiting", Phase::kWaiting}, NamedPhase{"seeking", Phase::kSeeking},
    NamedPhase{"sure", Phase::kSure},       NamedPhase{"unsure", Phase::kUnsure},
    NamedPhase{"distant", Phase::kDistant}, NamedPhase{"blind", Phase::kBlind},
    NamedPhase{"covered", Phase::kCovered}, NamedPhase{"arrived", Phase::kArrived},
    NamedPhase{"lost", Phase::kLost},       NamedPhase{"looking", Phase::kLooking}};

constexpr std::size_t kLongestText = 1000;

std::string OneWord(const std::string& text) {
  std::string word = PlainText(text, kLongestText);
  std::replace(word.begin(), word.end(), ' ', '_');
  return word;
}

}  // namespace

const char* ToString(Phase phase) {
  const auto* found = std::find_if(kPhases.begin(), kPhases.end(),
                                   [&](const NamedPhase& each) { return each.phase == phase; });
  return found == kPhases.end() ? "unknown" : found->name;
}

std::optional<Phase> ParsePhase(const std::string& word) {
  for (const NamedPhase& each : kPhases) {
    if (word == each.name) return each.phase;
  }
  return std::nullopt;
}

std::optional<std::string> Fields::Find(const std::string& key) const {
  const auto found =
      std::find_if(all_.begin(), all_.end(), [&](const auto& each) { return each.first == key; });
  if (found == all_.end()) return std::nullopt;
  return found->second;
}

std::optional<double> Fields::Number(const std::string& key) const {
  const auto text = Find(key);
  if (!text) return std::nullopt;
  return ParseNumber<double>(*text);
}

std::string DescribeEvent(const RunEvent& event) {
  std::string text = OneWord(event.what);
  for (const auto& [key, value] : event.fields.all()) {
    text += ' ' + OneWord(key) + '=' + OneWord(value);
  }
  if (!event.text.empty()) text += " : " + PlainText(event.text, kLongestText);
  return text;
}

}  // namespace trailcast::agent
