#pragma once

#include <dds/dds.h>

#include <map>
#include <string>

#include "services/base/result.h"
#include "services/dds/src/entities.h"
#include "services/exchange/messages.h"
#include "services/security/member.h"

namespace trailcast::dds {

// Whose the samples are that readers take, in a fleet with keys.
class Senders {
 public:
  // By the partition that the writer writes in, as no other member may. Null when nobody knows any
  // more who wrote it: anybody could have. Valid until the next call.
  [[nodiscard]] const security::Member* Of(const Reader& reader, dds_instance_handle_t writer);

 private:
  std::map<dds_instance_handle_t, security::Member> members_;
};

// Whether the message is its sender's to send (security::CheckAuthor); notes in a batch of segments
// how far that sender is believed.
[[nodiscard]] Result<void> CheckSender(const security::Member& sender, const std::string& name_key,
                                       exchange::Message& message);

}  // namespace trailcast::dds
