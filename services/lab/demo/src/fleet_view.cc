#include "services/lab/demo/fleet_view.h"

#include <fmt/format.h>

#include <variant>

#include "services/program/live_lines.h"

namespace trailcast::demo {
namespace {

using exchange::AgentMode;
using exchange::AgentRole;
using exchange::AgentStatus;

constexpr int kBarWidth = 20;

const char* ModeWord(const AgentStatus& status) {
  switch (status.mode) {
    case AgentMode::kStarting:
      return "starting";
    case AgentMode::kWaiting:
      return "waiting";
    case AgentMode::kTeaching:
      return "teaching";
    case AgentMode::kReplaying:
      return "following";
    case AgentMode::kArrived:
      return status.role == AgentRole::kScout ? "taught" : "arrived";
    case AgentMode::kStopped:
      return "stopped";
    case AgentMode::kFault:
      return "FAULT";
  }
  return "?";
}

std::string Doing(const AgentStatus& status) {
  switch (status.mode) {
    case AgentMode::kTeaching:
      return fmt::format("segment {:>2}, {:>2} features, {:.2f} m/s, {} unacknowledged",
                         status.segment, status.features, status.speed_mps, status.backlog);
    case AgentMode::kReplaying:
      return fmt::format("segment {:>2} of {:>2}, {:>2} features, {:.2f} m/s, {:.0f} % found",
                         status.segment + 1, status.segments, status.features, status.speed_mps,
                         100.0 * status.found_share);
    default:
      return status.detail;
  }
}

}  // namespace

void FleetView::Handle(const exchange::Message& message) {
  if (const auto* status = std::get_if<AgentStatus>(&message)) agents_[status->agent] = *status;
}

const AgentStatus* FleetView::Find(const AgentId& agent) const {
  const auto found = agents_.find(agent);
  return found == agents_.end() ? nullptr : &found->second;
}

std::string StatusLine(const std::string& name, const std::string& camera,
                       const AgentStatus* status) {
  const double progress = status == nullptr ? 0.0 : status->progress;
  std::string line = fmt::format("{:<11}{:<15}{} {:>3.0f} %  ", name, camera,
                                 program::ProgressBar(progress, kBarWidth), 100.0 * progress);
  if (status == nullptr) return line + "not heard of yet";
  return line + fmt::format("{:<10}{}", ModeWord(*status), Doing(*status));
}

}  // namespace trailcast::demo
