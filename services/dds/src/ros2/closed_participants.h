#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "services/dds/src/domain/peers.h"
#include "services/dds/src/entities.h"

namespace trailcast::dds {

// Watches for participants that are there and show neither writers nor readers. Programs with DDS
// Security do so towards those without keys, as the nodes of a robot that uses SROS 2.
class ClosedParticipants {
 public:
  [[nodiscard]] static Result<ClosedParticipants> Create(const Participant& participant);

  // Returns those that are there now, each as a phrase with its address. Members of a Trailcast
  // fleet, which may have keys, are not among them.
  [[nodiscard]] std::vector<std::string> Look();

 private:
  explicit ClosedParticipants(Peers peers) : peers_(std::move(peers)) {}

  Peers peers_;
  std::map<std::string, std::string> seen_;  // what is said of it, by participant
  std::set<std::string> open_;               // participants that show something
};

}  // namespace trailcast::dds
