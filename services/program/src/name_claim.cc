#include "services/program/name_claim.h"

#include <random>

namespace trailcast::program {

Result<void> NameClaim::See(const exchange::AgentStatus& status) const {
  if (status.agent != agent_ || status.instance == instance_) return {};
  using exchange::AgentMode;
  const bool ended = status.mode == AgentMode::kStopped;
  const bool yields = status.mode == AgentMode::kStarting && status.instance > instance_;
  if (ended || yields) return {};
  return Refuse(status.instance);
}

Result<void> NameClaim::See(const exchange::ClaimedName& claimed) const {
  const bool others = claimed.keeps != 0 && claimed.keeps != instance_;
  return claimed.agent == agent_ && others ? Refuse(claimed.keeps) : Result<void>();
}

Result<void> NameClaim::Refuse(std::uint64_t other) const {
  return Fail(ErrorCode::kConflict,
              "agent name '{}' is already used by another running agent (instance {:016x}): choose "
              "another with --name",
              agent_.value(), other);
}

std::uint64_t MakeInstance() {
  std::random_device random;
  const std::uint64_t high = random();
  return ((high << 32U) | random()) | 1U;
}

}  // namespace trailcast::program
