#include "services/fleet/sending.h"

#include <algorithm>
#include <variant>

namespace trailcast::fleet {
namespace {

using std::chrono::milliseconds;

// A robot that is there has answered by then.
constexpr milliseconds kRobotAnswers{3000};

}  // namespace

bool Sending::Hear(const exchange::Message& message) {
  const auto* report = std::get_if<mission::Report>(&message);
  if (report == nullptr || report->agent != mission_.agent || report->mission != mission_.id) {
    return false;
  }
  if (last_ && !mission::IsNewer(*report, *last_)) return false;
  const bool is_news = !last_ || last_->state != report->state || last_->detail != report->detail;
  last_ = *report;
  return is_news;
}

bool Sending::Answered(milliseconds since, milliseconds timeout) const {
  if (!last_) return since > timeout;
  if (last_->state != mission::State::kSent) return true;
  return since > std::min(kRobotAnswers, timeout);
}

bool Sending::Ended(milliseconds since) const {
  if (!last_ || !mission::HasEnded(last_->state)) return false;
  return last_->change > 0 || since > kRobotAnswers;
}

}  // namespace trailcast::fleet
