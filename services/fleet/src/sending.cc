#include "services/fleet/sending.h"

#include <fmt/format.h>

#include <algorithm>
#include <variant>

#include "services/base/time.h"
#include "services/mission/address.h"

namespace trailcast::fleet {
namespace {

using std::chrono::milliseconds;

// A robot that is in reach has answered by then.
constexpr milliseconds kRobotAnswers{3000};
// A robot may still refuse a mission that it has accepted, for example if there is no such route.
// That takes this long.
constexpr milliseconds kRobotDecides{3000};
constexpr milliseconds kAgain{200};
constexpr milliseconds kAgainWatched{2000};

}  // namespace

bool Sending::Hear(const exchange::Message& message) {
  const auto* report = std::get_if<mission::Report>(&message);
  if (report == nullptr || report->mission != mission_.id) return false;
  // A group's mission is reported of the group, and then of the robot that has it.
  const AgentId& awaited = last_ ? last_->agent : mission_.agent;
  const bool is_of_it =
      report->agent == awaited || mission::Means(awaited.value(), report->agent.value());
  if (!is_of_it) return false;
  if (report->state == mission::State::kPutOff) {
    put_off_ = report->detail;
    return false;
  }
  const bool is_same_robot = last_ && last_->agent == report->agent;
  if (is_same_robot && !mission::IsNewer(*report, *last_)) return false;
  const bool is_news = !last_ || last_->state != report->state || last_->detail != report->detail ||
                       last_->agent != report->agent;
  last_ = *report;
  return is_news;
}

bool Sending::Answered(milliseconds since, milliseconds timeout) const {
  if (!last_) return since > timeout;
  switch (last_->state) {
    case mission::State::kSent:
      return last_->waits_for == mission::WaitsFor::kTurn ||
             since > std::min(kRobotAnswers, timeout);
    case mission::State::kAccepted:
      return since > std::min(kRobotDecides, timeout);
    case mission::State::kFetching:
      return last_->waits_for != mission::WaitsFor::kNothing ||
             since > std::min(kRobotDecides, timeout);
    default:
      return true;
  }
}

milliseconds Sending::SayAgain() const { return last_ ? kAgainWatched : kAgain; }

Result<mission::Report> Sending::Outcome(milliseconds timeout) const {
  if (last_) return *last_;
  if (!put_off_.empty()) {
    return Fail(ErrorCode::kUnavailable, "the mission for {} was put off: {}",
                mission_.agent.value(), put_off_);
  }
  return Fail(ErrorCode::kUnavailable,
              "neither {} nor a route server answered within {:.1f} s: have they the same --domain "
              "and --dds-tag? (Robots take missions while 'trailcast-agent serve' runs.)",
              mission_.agent.value(), Seconds(timeout));
}

bool Sending::Ended(milliseconds since) const {
  if (!last_ || !mission::HasEnded(last_->state)) return false;
  return last_->change > 0 || since > kRobotAnswers;
}

SendingToAll::SendingToAll(mission::Mission mission) : whole_(mission) {
  const auto addressed = mission::ParseAddress(mission.agent.value());
  for (const std::string& each :
       addressed ? *addressed : std::vector<std::string>{mission.agent.value()}) {
    mission.agent = AgentId(each);
    each_.emplace_back(mission);
  }
}

std::optional<mission::Report> SendingToAll::Hear(const exchange::Message& message) {
  if (each_.size() > 1 && whole_.Hear(message)) return whole_.last();
  for (Sending& sending : each_) {
    if (sending.Hear(message)) return sending.last();
  }
  return std::nullopt;
}

template <typename Holds>
bool SendingToAll::ForAll(const Holds& holds) const {
  if (each_.size() > 1 && whole_.last()) return holds(whole_);
  return std::all_of(each_.begin(), each_.end(), holds);
}

bool SendingToAll::Answered(milliseconds since, milliseconds timeout) const {
  return ForAll([&](const Sending& each) { return each.Answered(since, timeout); });
}

bool SendingToAll::Ended(milliseconds since) const {
  return ForAll([&](const Sending& each) { return each.Ended(since); });
}

bool SendingToAll::heard() const {
  return ForAll([](const Sending& each) { return each.last().has_value(); });
}

milliseconds SendingToAll::SayAgain() const { return heard() ? kAgainWatched : kAgain; }

Result<std::vector<mission::Report>> SendingToAll::Outcome(milliseconds timeout) const {
  std::vector<mission::Report> reports;
  for (const Sending& each : each_) {
    if (each.last()) reports.push_back(*each.last());
  }
  const bool is_known = !reports.empty() && !whole_.last();
  if (is_known) return reports;
  const auto whole = each_.size() > 1 ? whole_.Outcome(timeout) : each_.front().Outcome(timeout);
  if (!whole) return tl::unexpected(whole.error());
  return std::vector{*whole};
}

}  // namespace trailcast::fleet
