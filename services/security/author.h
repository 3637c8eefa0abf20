#pragma once

#include <string>

#include "services/base/result.h"
#include "services/exchange/messages.h"
#include "services/security/member.h"

namespace trailcast::security {

// What DDS cannot know: whether a message is its sender's to send. DDS vouches for `sender`, whose
// partition it came in. The message must name that sender as its author; a status must tell the
// sender's role; commands for robots and their answers may be passed on by a server; a scout
// announces only what it taught itself, and no labels, which are operators'. kInvalidArgument with
// what is wrong otherwise.
[[nodiscard]] Result<void> CheckAuthor(const exchange::Message& message, const Member& sender,
                                       const std::string& name_key);

}  // namespace trailcast::security
