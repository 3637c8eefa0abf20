#include "services/lab/demo/network_show.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>
#include <variant>

#include "services/lab/demo/src/network_words.h"
#include "services/network/words.h"

namespace trailcast::demo {
namespace {

using exchange::AgentMode;

// The server looks for junctions beside its other work.
constexpr std::chrono::seconds kProposalsWithin{15};
constexpr std::ptrdiff_t kEnoughProposals = 2;
constexpr std::size_t kLastLines = 40;
// A robot that was carried to a place without a path waits for one, and gets it by then.
constexpr std::chrono::seconds kWaitsFor{10};

}  // namespace

NetworkShow::NetworkShow(std::filesystem::path programs, std::filesystem::path folder,
                         const program::CommonOptions& network, const NetworkPlan& plan)
    : programs_(std::move(programs)), folder_(std::move(folder)), network_(network), plan_(plan) {}

Result<ChildProcess> NetworkShow::Type(const std::vector<std::string>& words, bool shown) {
  if (shown) typed_.push_back(fmt::format("trailcast {}", fmt::join(words, " ")));
  std::vector<std::string> all{(programs_ / "trailcast").string()};
  all.insert(all.end(), words.begin(), words.end());
  for (std::string& word : NetworkWords(network_, "operator")) all.push_back(std::move(word));
  return ChildProcess::Start(all, folder_ / fmt::format("operator-{}.log", ++logs_));
}

Result<void> NetworkShow::TypeNext() {
  const std::vector<std::string> words = std::move(to_type_.front());
  to_type_.erase(to_type_.begin());
  auto started = Type(words, /*shown=*/true);
  if (!started) return tl::unexpected(started.error());
  running_ = std::move(*started);
  return {};
}

Result<bool> NetworkShow::Done() {
  const auto status = running_->Poll();
  if (!status) return false;
  if (status->ok()) return true;
  return Fail(ErrorCode::kUnavailable, "'{}' {}: {}", typed_.back(), ToString(*status),
              fmt::join(LastLines(running_->log(), kLastLines), "\n    "));
}

bool NetworkShow::AllTaught(const FleetView& view) const {
  return std::all_of(plan_.robots.begin(), plan_.robots.end(), [&](const DemoRobot& robot) {
    if (!robot.is_scout()) return true;
    const auto* status = view.Find(AgentId(robot.name));
    return status != nullptr && status->mode == AgentMode::kArrived;
  });
}

Result<void> NetworkShow::SendAll() {
  for (const NetworkPlan::Journey& journey : plan_.journeys) {
    auto sent = Type({"send", plan_.robots[journey.robot].name, "goto", "lab-2", "--from",
                      journey.from, "--wait"},
                     /*shown=*/true);
    if (!sent) return tl::unexpected(sent.error());
    sends_.push_back(std::move(*sent));
  }
  return {};
}

void NetworkShow::TakeAnswer(Time now) {
  const std::vector<std::string> answer = LastLines(running_->log(), kLastLines);
  running_.reset();
  if (stage_ != Stage::kProposals) {
    for (const std::string& line : answer) typed_.push_back("  " + line);
    return;
  }
  const auto proposed = std::count_if(answer.begin(), answer.end(), [](const std::string& line) {
    return network::ParseListed(line).proposal.has_value();
  });
  if (proposed < kEnoughProposals && now <= proposals_until_) return;
  // The operator knows the junctions that are too short to be found.
  to_type_ = {{"network", "confirm", "all", "above", "0.8"},
              {"network", "join", "hall@3", "round@2"},
              {"network", "name", "lab-2", fmt::format("hall@{}", plan_.goal_m)}};
  stage_ = Stage::kJoin;
}

Result<void> NetworkShow::Step(const FleetView& view, Time now) {
  if (running_) {
    const auto done = Done();
    if (!done) return tl::unexpected(done.error());
    if (!*done) return {};
    TakeAnswer(now);
  }
  if (!to_type_.empty()) return TypeNext();
  switch (stage_) {
    case Stage::kTaught:
      if (!AllTaught(view)) return {};
      stage_ = Stage::kProposals;
      proposals_until_ = now + kProposalsWithin;
      [[fallthrough]];
    case Stage::kProposals: {
      auto asked = Type({"network", "proposals"}, /*shown=*/false);
      if (!asked) return tl::unexpected(asked.error());
      running_ = std::move(*asked);
      return {};
    }
    case Stage::kJoin:
      stage_ = Stage::kSend;
      return SendAll();
    case Stage::kSend: {
      const auto* status = view.Find(AgentId(plan_.robots[plan_.journeys.front().robot].name));
      if (status == nullptr || status->mode != AgentMode::kReplaying) break;
      to_type_ = {{"network", "close", "hall",
                   fmt::format("{}..{}", plan_.closed_from_m, plan_.closed_to_m)}};
      stage_ = Stage::kClose;
      return TypeNext();
    }
    case Stage::kClose:
      stage_ = Stage::kWait;
      break;
    case Stage::kWait:
    case Stage::kOver:
      break;
  }
  if (AllEnded(now)) stage_ = Stage::kOver;
  return {};
}

void NetworkShow::Hear(const std::vector<exchange::Message>& messages) {
  for (const exchange::Message& message : messages) {
    const auto* report = std::get_if<mission::Report>(&message);
    if (report == nullptr) continue;
    const auto [known, is_first] = reports_.try_emplace(report->agent, *report);
    if (!is_first && mission::IsNewer(*report, known->second)) known->second = *report;
  }
}

std::optional<mission::Report> NetworkShow::ReportOf(std::size_t journey) const {
  const auto known = reports_.find(AgentId(plan_.robots[plan_.journeys[journey].robot].name));
  return known == reports_.end() ? std::nullopt : std::optional(known->second);
}

bool NetworkShow::AllEnded(Time now) {
  bool one_waits = false;
  for (std::size_t i = 0; i < sends_.size(); ++i) {
    if (sends_[i].Poll()) continue;
    const DemoRobot& robot = plan_.robots[plan_.journeys[i].robot];
    const auto report = ReportOf(i);
    one_waits = !robot.carry.empty() && report && report->waits_for == mission::WaitsFor::kWay;
    if (!one_waits) {
      waits_since_.reset();
      return false;
    }
  }
  if (one_waits && !waits_since_) waits_since_ = now;
  return !one_waits || now - *waits_since_ >= kWaitsFor;
}

std::vector<JourneyEnd> NetworkShow::Ends() const {
  std::vector<JourneyEnd> ends;
  for (std::size_t i = 0; i < sends_.size(); ++i) {
    const auto lines = LastLines(sends_[i].log(), 1);
    ends.push_back({lines.empty() ? "" : lines.front(), ReportOf(i)});
  }
  return ends;
}

}  // namespace trailcast::demo
