#pragma once

#include <string>

#include "services/base/result.h"
#include "services/security/certificates.h"

namespace trailcast::security {

// Signs the text as S/MIME: it stays readable and the signature follows it, as `openssl smime -sign
// -text` does and DDS Security requires for governance and permissions.
[[nodiscard]] Result<std::string> Sign(const std::string& text, const Identity& authority);

// Returns the signed text. kCorrupt means that `authority`, a certificate, did not sign it, or that
// it was changed.
[[nodiscard]] Result<std::string> OpenSigned(const std::string& signed_text,
                                             const std::string& authority);

}  // namespace trailcast::security
