#pragma once

#include <dds/dds.h>

#include <map>
#include <string>

#include "services/base/result.h"
#include "services/dds/src/entities.h"
#include "services/exchange/messages.h"
#include "services/security/member.h"

namespace trailcast::dds {

// Tells whose samples readers take, in a fleet with keys.
class Senders {
 public:
  // Returns the member by the writer's partition, in which no other member may write. It is null if
  // nobody knows any more who wrote the sample, so that anybody could have. It is valid until the
  // next call.
  [[nodiscard]] const security::Member* Of(const Reader& reader, dds_instance_handle_t writer);

 private:
  std::map<dds_instance_handle_t, security::Member> members_;
};

// Checks that the message is its sender's to send (security::CheckAuthor), and notes in a batch of
// segments how far that sender is trusted.
[[nodiscard]] Result<void> CheckSender(const security::Member& sender, const std::string& name_key,
                                       exchange::Message& message);

}  // namespace trailcast::dds
