#include "agent/link/mission_handler.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <variant>

#include "services/base/durable_file.h"
#include "services/base/number.h"
#include "services/base/process_name.h"
#include "services/base/text.h"
#include "services/exchange/bounds.h"

namespace trailcast::agent {
namespace {

namespace fs = std::filesystem;
using mission::State;

constexpr const char* kMissionsFirstLine = "trailcast-missions 2";
constexpr std::chrono::milliseconds kAgain{1000};
constexpr std::size_t kFields = 12;
constexpr std::size_t kMostOfWay = 20;  // the most bytes by which WithWay makes a detail longer

// Texts have no control characters (exchange::CheckBounds), and so no tabs.
std::vector<std::string> FieldsIn(const std::string& line) {
  std::vector<std::string> fields;
  std::size_t at = 0;
  while (true) {
    const std::size_t tab = line.find('\t', at);
    fields.push_back(line.substr(at, tab - at));
    if (tab == std::string::npos) return fields;
    at = tab + 1;
  }
}

// Tells people which path a robot is on, if it is not the first one.
std::string WithWay(const std::string& detail, std::uint32_t way) {
  return way < 2 ? detail : fmt::format("{}{}(way {})", detail, detail.empty() ? "" : " ", way);
}

}  // namespace

Result<void> MissionHandler::Load() {
  std::error_code ignored;
  if (file_.empty() || !fs::exists(file_, ignored)) return {};
  const auto wrong = [&] {
    return Fail(ErrorCode::kCorrupt,
                "{} does not hold this robot's missions, or is damaged: move it away, and send "
                "what is still to be done once more",
                file_.string());
  };
  std::ifstream stream(file_);
  std::string line;
  if (!std::getline(stream, line) || line != kMissionsFirstLine) return wrong();
  while (std::getline(stream, line)) {
    const std::vector<std::string> fields = FieldsIn(line);
    if (fields.size() != kFields) return wrong();
    std::vector<std::uint32_t> numbers;
    for (std::size_t i = 2; i < 10; ++i) {
      const auto number = ParseNumber<std::uint32_t>(fields[i]);
      if (!number) return wrong();
      numbers.push_back(*number);
    }
    const bool known = numbers[2] < mission::kStates &&
                       numbers[5] <= static_cast<std::uint32_t>(mission::WaitsFor::kPlace);
    if (!known || Find(fields[0]) != nullptr) return wrong();
    kept_.push_back({.mission = {.agent = self_,
                                 .id = fields[0],
                                 .client = AgentId(fields[1]),
                                 .orders = fields[10],
                                 .goes_on = numbers[0] != 0},
                     .last = {.agent = self_,
                              .mission = fields[0],
                              .change = numbers[1],
                              .state = static_cast<State>(numbers[2]),
                              .task = numbers[3],
                              .way = numbers[4],
                              .waits_for = static_cast<mission::WaitsFor>(numbers[5]),
                              .detail = fields[11]},
                     .lap = numbers[6],
                     .confirmed = numbers[7] != 0});
    const bool in_bounds =
        exchange::CheckBounds(kept_.back().mission) && exchange::CheckBounds(kept_.back().last);
    if (!in_bounds || kept_.size() > kMostKept) return wrong();
  }
  for (const Kept& kept : kept_) {
    if (mission::HasEnded(kept.last.state)) continue;
    if (current_) return wrong();
    auto tasks = mission::ParseOrders(kept.mission.orders);
    if (!tasks || kept.last.task >= tasks->size()) return wrong();
    Begin(kept, *std::move(tasks));
    current_->begun = true;
  }
  return {};
}

void MissionHandler::Begin(const Kept& kept, std::vector<mission::Task> tasks) {
  current_ = Current{.mission = kept.mission,
                     .tasks = std::move(tasks),
                     .task = kept.last.task,
                     .lap = kept.lap,
                     .photos = mission::PhotosIn(kept.mission.orders)};
  if (auto going = mission::GoingIn(kept.mission.orders)) current_->going = *std::move(going);
}

Result<void> MissionHandler::Keep() const {
  if (file_.empty()) return {};
  std::string text = std::string(kMissionsFirstLine) + "\n";
  for (const Kept& kept : kept_) {
    const mission::Report& last = kept.last;
    text += fmt::format("{}\t{}\t{:d}\t{}\t{:d}\t{}\t{}\t{:d}\t{}\t{:d}\t{}\t{}\n", kept.mission.id,
                        kept.mission.client.value(), kept.mission.goes_on, last.change,
                        static_cast<int>(last.state), last.task, last.way,
                        static_cast<int>(last.waits_for), kept.lap, kept.confirmed,
                        kept.mission.orders, last.detail);
  }
  return ReplaceFile(file_, text);
}

void MissionHandler::KeepOrSay() {
  if (auto kept = Keep(); !kept) {
    news_.push_back("not remembered after a restart: " + kept.error().message);
  }
}

MissionHandler::Kept* MissionHandler::Find(const std::string& id) {
  const auto found = std::find_if(kept_.begin(), kept_.end(),
                                  [&](const Kept& kept) { return kept.mission.id == id; });
  return found == kept_.end() ? nullptr : &*found;
}

MissionHandler::Kept& MissionHandler::CurrentKept() { return *Find(current_->mission.id); }

void MissionHandler::Handle(const exchange::Message& message) {
  if (const auto* mission = std::get_if<mission::Mission>(&message)) {
    if (mission->agent == self_) Take(*mission);
  } else if (const auto* status = std::get_if<exchange::AgentStatus>(&message)) {
    const bool has_ended = status->mode == exchange::AgentMode::kStopped;
    if (status->on_duty || has_ended) keepers_.Handle(message);
  } else if (std::holds_alternative<exchange::AgentGone>(message)) {
    keepers_.Handle(message);
  } else if (const auto* report = std::get_if<mission::Report>(&message)) {
    if (report->agent == self_ && report->relayed) Compare(*report);
  }
}

void MissionHandler::Answer(Kept& kept, State state, const std::string& detail,
                            mission::WaitsFor waits_for) {
  ++kept.last.change;
  kept.last.state = state;
  kept.last.waits_for = waits_for;
  // Nobody needs the path of a mission that has ended.
  const auto going =
      mission::HasEnded(state) ? std::nullopt : mission::GoingIn(kept.mission.orders);
  kept.last.way = going ? going->way : 1;
  kept.last.detail =
      WithWay(PlainText(detail, exchange::kMaxLineBytes - kMostOfWay), kept.last.way);
  kept.confirmed = false;
  kept.due = true;
  news_.push_back(fmt::format("mission {} of {}, {}: {}{}{}", kept.mission.id,
                              WithoutProcess(kept.mission.client.value()), kept.mission.orders,
                              mission::ToString(state), kept.last.detail.empty() ? "" : ": ",
                              kept.last.detail));
}

bool MissionHandler::IsServers(const mission::Mission& mission) {
  if (mission.relayed || keepers_.empty()) return false;
  if (unkept_.size() >= kMostKept && !unkept_.contains(mission.id)) return true;
  return ++unkept_[mission.id] < kSentInVain;
}

void MissionHandler::Take(const mission::Mission& mission) {
  if (Kept* known = Find(mission.id)) {
    if (mission.relayed && current_ && current_->mission.id == mission.id) Amend(*known, mission);
    known->due = true;  // its sender has not heard the answer
    return;
  }
  if (IsServers(mission)) return;
  // A server that does not know yet what this robot does hands its mission over again later.
  if (mission.relayed && current_) return;
  // A second or later path is for a robot that has begun. A robot that forgot its mission must not
  // move on it.
  const auto going = mission::GoingIn(mission.orders);
  if (going && going->way > 1) return;
  unkept_.erase(mission.id);
  // The missions that ended first are dropped first; the current one stays.
  if (kept_.size() >= kMostKept) {
    kept_.erase(std::find_if(kept_.begin(), kept_.end(),
                             [](const Kept& kept) { return mission::HasEnded(kept.last.state); }));
  }
  kept_.push_back({.mission = mission, .last = {.agent = self_, .mission = mission.id}});
  Kept& kept = kept_.back();
  auto tasks = mission::ParseOrders(mission.orders);
  if (!tasks) {
    Answer(kept, State::kRefused, tasks.error().message);
  } else if (current_) {
    Answer(kept, State::kRefused,
           fmt::format("busy with mission {}: {}", current_->mission.id,
                       mission::ToText(current_->tasks[current_->task])));
  } else {
    Answer(kept, State::kAccepted, "");
  }
  // A mission that is not remembered could be done twice.
  if (auto remembered = Keep(); !remembered && kept.last.state == State::kAccepted) {
    Answer(kept, State::kRefused, remembered.error().message);
  }
  if (kept.last.state == State::kAccepted) Begin(kept, *std::move(tasks));
}

// A path that comes late is an old one.
void MissionHandler::Amend(Kept& kept, const mission::Mission& mission) {
  const mission::Going& before = current_->going;
  const auto going = mission::GoingIn(mission.orders);
  if (!going || going->to != before.to || going->way <= before.way) return;
  const bool begun = current_->begun;
  kept.mission.orders = mission.orders;
  kept.last.task = 0;
  kept.lap = 0;
  Begin(kept, *mission::ParseOrders(mission.orders));
  current_->begun = begun;
  amended_ = true;
  const bool replanned = going->why == mission::Going::Why::kReplanned;
  Answer(kept, kept.last.state, (replanned ? "re-planned: " : "") + going->because);
  KeepOrSay();
}

void MissionHandler::GoOnAt(std::uint32_t task) {
  current_->task = task;
  CurrentKept().last.task = task;
  KeepOrSay();
}

void MissionHandler::Compare(const mission::Report& report) {
  if (report.state == State::kPutOff) return;
  if (const auto unkept = unkept_.find(report.mission); unkept != unkept_.end()) {
    unkept->second = 0;
    if (mission::HasEnded(report.state)) unkept_.erase(unkept);
  }
  // Every later report has to be newer than that.
  const bool can_be_newer = report.change < std::numeric_limits<std::uint32_t>::max();
  Kept* kept = Find(report.mission);
  if (kept == nullptr) {
    const bool is_of_this_robot = report.change > 0 && !mission::HasEnded(report.state);
    if (!is_of_this_robot || !can_be_newer || unknown_.size() >= kMostKept) return;
    mission::Report end = report;
    end.relayed = false;
    ++end.change;
    end.state = State::kFailed;
    end.waits_for = mission::WaitsFor::kNothing;
    end.detail = "its robot has come back without any record of it, and does it no more";
    unknown_[report.mission] = std::move(end);
  } else if (kept->last.change == report.change) {
    kept->confirmed = true;  // not written to disk, because repeating it after a restart does no
                             // harm
  } else if (report.change > kept->last.change && can_be_newer) {
    // This robot's disk is an older one, and its reports since then are lost.
    kept->last.change = report.change + 1;
    kept->confirmed = false;
    kept->due = true;
    KeepOrSay();
  } else if (kept->confirmed) {
    kept->due = true;  // the server's disk is an older one
  }
}

void MissionHandler::Tell(State state, const std::string& detail, mission::WaitsFor waits_for) {
  if (!current_) return;
  Kept& kept = CurrentKept();
  kept.last.task = current_->task;
  Answer(kept, state, detail, waits_for);
  if (mission::HasEnded(state)) current_.reset();
  KeepOrSay();
}

void MissionHandler::NoteDone() {
  if (!current_) return;
  current_->begun = false;
  ++current_->lap;
  if (current_->lap >= current_->tasks[current_->task].laps) {
    current_->lap = 0;
    ++current_->task;
  }
  Kept& kept = CurrentKept();
  kept.lap = current_->lap;
  if (current_->task < current_->tasks.size()) kept.last.task = current_->task;
  KeepOrSay();
}

std::vector<exchange::Message> MissionHandler::Due(Time now, bool server_there) {
  const bool again = server_there && now >= again_at_;
  if (again) again_at_ = now + kAgain;
  std::vector<exchange::Message> due;
  for (Kept& kept : kept_) {
    if (!std::exchange(kept.due, false) && !(again && !kept.confirmed)) continue;
    due.emplace_back(kept.last);
  }
  for (auto& [id, end] : std::exchange(unknown_, {})) {
    news_.push_back(fmt::format("mission {}, of which a server asks: {}: {}", id,
                                mission::ToString(end.state), end.detail));
    due.emplace_back(std::move(end));
  }
  return due;
}

}  // namespace trailcast::agent
