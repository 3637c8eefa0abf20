#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "services/dds/src/entities.h"

namespace trailcast::dds {

// Watches the participants that DDS discovers, members of the fleet and strangers.
class Peers {
 public:
  // `with_proof` also watches what they write and read.
  [[nodiscard]] static Result<Peers> Create(const Participant& participant, bool with_proof);

  struct SaidOfItself {
    std::string about;   // for a line of the log: addresses, and names if it tells any
    bool names = false;  // it tells names unencrypted, as members of a fleet with keys do not
    std::string name{};  // from its user data, as is the version
    std::optional<std::uint32_t> version{};
    std::string address{};  // "10.0.0.7:41830"; empty if it tells none
  };
  struct Handlers {
    // `participant` is the first three words of its GUID; `said` is its own account, without proof.
    std::function<void(const std::string& participant, const SaidOfItself& said)> seen;
    // A writer or reader of it was discovered, which proves that it is a member.
    std::function<void(const std::string& participant)> proven;
    std::function<void(const std::string& participant)> gone;
  };
  // Reports the changes since the last call.
  [[nodiscard]] Result<void> Look(const Handlers& handlers);

 private:
  Peers(dds_guid_t self, Reader participants)
      : self_(self), participants_(std::move(participants)) {}

  dds_guid_t self_;
  Reader participants_;
  std::vector<Reader> endpoints_;  // publications and subscriptions, if with_proof
};

// Returns it as Cyclone writes it: "b4bcbdad:8cb94d6f:9f600af6".
[[nodiscard]] std::string ParticipantText(const dds_guid_t& guid);

}  // namespace trailcast::dds
