#pragma once

#include <functional>
#include <string>

#include "services/dds/src/entities.h"

namespace trailcast::dds {

// The participants that DDS discovers, members of the fleet and strangers.
class Peers {
 public:
  [[nodiscard]] static Result<Peers> Create(const Participant& participant);

  struct SaidOfItself {
    std::string about;   // for a line of the log: addresses, and names if there are any
    bool names = false;  // in the clear, which members of a fleet do not
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
  Peers(dds_guid_t self, Reader participants, Reader publications, Reader subscriptions)
      : self_(self),
        participants_(std::move(participants)),
        publications_(std::move(publications)),
        subscriptions_(std::move(subscriptions)) {}

  dds_guid_t self_;
  Reader participants_;
  Reader publications_;
  Reader subscriptions_;
};

// As Cyclone writes it: "b4bcbdad:8cb94d6f:9f600af6".
[[nodiscard]] std::string ParticipantText(const dds_guid_t& guid);

}  // namespace trailcast::dds
