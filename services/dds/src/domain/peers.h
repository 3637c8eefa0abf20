#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "services/dds/src/entities.h"

namespace trailcast::dds {

// The participants that DDS discovers, members of the fleet and strangers.
class Peers {
 public:
  // `with_proof`: looks at what they write and read, too.
  [[nodiscard]] static Result<Peers> Create(const Participant& participant, bool with_proof);

  struct SaidOfItself {
    std::string about;   // for a line of the log: addresses, and names if there are any
    bool names = false;  // in the clear, which members of a fleet with keys do not
    std::string name{};  // of its user data, as is the version
    std::optional<std::uint32_t> version{};
    std::string address{};  // "10.0.0.7:41830"; empty: it says none
  };
  struct Handlers {
    // `participant`: the first three words of its GUID; `said`: what it says of itself, unproven.
    std::function<void(const std::string& participant, const SaidOfItself& said)> seen;
    // Something it writes or reads is known, which only members can say.
    std::function<void(const std::string& participant)> proven;
    std::function<void(const std::string& participant)> gone;
  };
  // What changed since the last call.
  [[nodiscard]] Result<void> Look(const Handlers& handlers);

 private:
  Peers(dds_guid_t self, Reader participants)
      : self_(self), participants_(std::move(participants)) {}

  dds_guid_t self_;
  Reader participants_;
  std::vector<Reader> endpoints_;  // publications and subscriptions, with proof
};

// As Cyclone writes it: "b4bcbdad:8cb94d6f:9f600af6".
[[nodiscard]] std::string ParticipantText(const dds_guid_t& guid);

}  // namespace trailcast::dds
