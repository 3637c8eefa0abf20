#pragma once

#include <optional>
#include <string>
#include <vector>

#include "services/dds/src/entities.h"
#include "services/security/member_keys.h"

namespace trailcast::dds {

// The topic on which route servers give the fleet's list of revoked certificates to all members,
// including themselves, in a fleet with keys. The authority signs a list, so it does not matter who
// brings it. Every member that takes one joins again. A server therefore writes its own list once,
// when it joins; later members get it, too.
class RevocationTopic {
 public:
  // Opens what the keys' permissions allow; `wait_set` then wakes for what comes.
  [[nodiscard]] static Result<RevocationTopic> Open(const Participant& participant,
                                                    WaitSet& wait_set,
                                                    const security::MemberKeys& keys);

  struct Offer {
    std::string from;  // "server/4f2a9c0d11223344", as DDS guarantees
    std::string text;  // as it came, cut off beyond the length that any list may have
  };
  // Returns what came since the last call.
  [[nodiscard]] std::vector<Offer> Take();

 private:
  RevocationTopic(Topic topic, Reader reader)
      : topic_(std::move(topic)), reader_(std::move(reader)) {}
  [[nodiscard]] Result<void> Write(const Participant& participant,
                                   const security::MemberKeys& keys);

  Topic topic_;
  Reader reader_;
  std::optional<Writer> writer_;  // only a server has one
};

}  // namespace trailcast::dds
