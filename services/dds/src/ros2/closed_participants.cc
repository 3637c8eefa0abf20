#include "services/dds/src/ros2/closed_participants.h"

#include <utility>

namespace trailcast::dds {

Result<ClosedParticipants> ClosedParticipants::Create(const Participant& participant) {
  auto peers = Peers::Create(participant, /*with_proof=*/true);
  if (!peers) return tl::unexpected(peers.error());
  return ClosedParticipants(*std::move(peers));
}

std::vector<std::string> ClosedParticipants::Look() {
  // Entries that could not be read stay for the next look.
  (void)peers_.Look({.seen =
                         [this](const std::string& who, const Peers::SaidOfItself& said) {
                           if (!said.version) seen_.insert_or_assign(who, said.about);
                         },
                     .proven = [this](const std::string& who) { open_.insert(who); },
                     .gone =
                         [this](const std::string& who) {
                           seen_.erase(who);
                           open_.erase(who);
                         }});
  std::vector<std::string> closed;
  for (const auto& [who, about] : seen_) {
    if (!open_.contains(who)) closed.push_back(about);
  }
  return closed;
}

}  // namespace trailcast::dds
