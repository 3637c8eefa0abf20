#pragma once

#include <string>

#include "services/base/result.h"
#include "services/exchange/messages.h"
#include "services/security/member.h"

namespace trailcast::security {

// Checks that a message is its sender's to send, which DDS cannot know. DDS guarantees `sender`, in
// whose partition the message came. The message must name the sender as its author, and a status
// must tell the sender's role. A server may pass on commands for robots and their answers. A scout
// may announce only what it taught itself, without labels, which are the operators'. The error is
// kInvalidArgument and says what is wrong.
[[nodiscard]] Result<void> CheckAuthor(const exchange::Message& message, const Member& sender,
                                       const std::string& name_key);

}  // namespace trailcast::security
