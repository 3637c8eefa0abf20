#pragma once

#include <string>

#include "services/base/result.h"
#include "services/security/certificates.h"

namespace trailcast::security {

// The text signed as S/MIME: readable, the signature behind it, as `openssl smime -sign -text`
// makes it and DDS Security expects of governance and permissions.
[[nodiscard]] Result<std::string> Sign(const std::string& text, const Identity& authority);

// The text that was signed. kCorrupt if not by `authority`, a certificate, or changed since.
[[nodiscard]] Result<std::string> OpenSigned(const std::string& signed_text,
                                             const std::string& authority);

}  // namespace trailcast::security
