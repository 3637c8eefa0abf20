#pragma once

#include <optional>
#include <string>
#include <vector>

#include "services/dds/src/entities.h"
#include "services/security/member_keys.h"

namespace trailcast::dds {

// Where route servers give the fleet's list of revoked certificates to all members, themselves
// included; only of a fleet with keys. A list is its authority's word, whoever brings it, and each
// who takes one joins anew: so a server writes its own once, when it joins, and who comes later
// gets it, too.
class RevocationTopic {
 public:
  // As the keys' permissions allow. `wait_set` then wakes for what comes.
  [[nodiscard]] static Result<RevocationTopic> Open(const Participant& participant,
                                                    WaitSet& wait_set,
                                                    const security::MemberKeys& keys);

  struct Offer {
    std::string from;  // "server/4f2a9c0d11223344", by DDS's word
    std::string text;  // as it came; cut off where it is longer than any list may be
  };
  // What came since the last call.
  [[nodiscard]] std::vector<Offer> Take();

 private:
  RevocationTopic(Topic topic, Reader reader)
      : topic_(std::move(topic)), reader_(std::move(reader)) {}
  [[nodiscard]] Result<void> Write(const Participant& participant,
                                   const security::MemberKeys& keys);

  Topic topic_;
  Reader reader_;
  std::optional<Writer> writer_;  // a server's
};

}  // namespace trailcast::dds
