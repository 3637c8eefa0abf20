#include "services/fleet/sending.h"

#include <fmt/format.h>

#include <algorithm>
#include <variant>

#include "services/base/time.h"

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
  if (report == nullptr || report->agent != mission_.agent || report->mission != mission_.id) {
    return false;
  }
  if (report->state == mission::State::kPutOff) {
    put_off_ = report->detail;
    return false;
  }
  if (last_ && !mission::IsNewer(*report, *last_)) return false;
  const bool is_news = !last_ || last_->state != report->state || last_->detail != report->detail;
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

}  // namespace trailcast::fleet
